"""Run the command line as `python -m kulman`."""

from .cli import main

main()
