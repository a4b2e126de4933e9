"""Exceptions with the messages of the program."""


class Error(Exception):
    """Base class of all failures that perilink reports."""


class InputError(Error, ValueError):
    """Refused input: the message gives the place, the value, what is allowed and a suggestion.

    Attributes:
        path: file of the case; "case" for a case that was built or changed in Python
        line: line in that file, from 1; 0 where there is none
        key: dotted key path, such as "body.horizon" or "materials[2].region"
    """

    def __init__(self, message: str, path: str = "", line: int = 0, key: str = "") -> None:
        super().__init__(message)
        self.path = path
        self.line = line
        self.key = key


class SolverError(Error):
    """The solver cannot continue; the message gives the reason."""


class FileError(Error, OSError):
    """A file cannot be read or written."""
