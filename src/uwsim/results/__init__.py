"""Results as they are kept on disk; read and written without MuJoCo."""
