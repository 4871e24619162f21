"""The solid, its mesh, its body and the contact; closed-form solutions to hold them against."""
