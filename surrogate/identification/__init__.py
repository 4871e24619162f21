"""From measured forces to toughness and wear strength, with what leaves them in doubt."""
