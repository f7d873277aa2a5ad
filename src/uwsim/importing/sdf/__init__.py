"""Reading of SDF, the format of Gazebo: files, included models, frames."""
