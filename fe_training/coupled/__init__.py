"""The campaign over toughness, stiffening, friction and wear, and what is made of it."""
