"""What plug-ins of Gazebo and of UUV Simulator become: hydrodynamics, thrusters, fins, sensors."""
