"""The command line's options, its console, and the commands for teachers."""
