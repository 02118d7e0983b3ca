"""`python -m drumrs` is the command `drumrs`."""

from drumrs.cli import main

if __name__ == "__main__":
    main()
