"""What linear kinematics leaves out."""
