"""Mode computation (Fig. 1): natural frequencies and shapes of the beam."""
