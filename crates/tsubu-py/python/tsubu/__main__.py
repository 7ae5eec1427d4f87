"""`python -m tsubu` is the program."""

from tsubu._program import main

if __name__ == "__main__":
    main()
