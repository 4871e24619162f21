"""What a scene asks: forces, regimes, transition radii, slopes, uncertainty."""
