"""What a hydrodynamics file says: specs, their errors, and the numbers for the kernel."""
