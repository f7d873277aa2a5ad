"""Results on disk; read and written without MuJoCo."""
