"""The command `wirecut`, a module for each subcommand."""
