"""The program in a browser: a thin door to the same calls as the command line's."""
