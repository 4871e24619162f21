"""What people have in files: measurements, materials, units, and whether they can be meant."""
