"""errors.py: exceptions of firn, one for each status of the C library."""


class Error(Exception):
    """A call failed. `status` is the exit code of `firn` for the same failure."""
    status = 1


class UsageError(Error, ValueError):
    """An argument is invalid: an unknown name, a value out of range, a wrong shape or dtype."""
    status = 2


class DataError(Error, ValueError):
    """An input file or array is damaged or unsupported."""
    status = 65


class InputError(Error, OSError):
    """An input file is missing or unreadable."""
    status = 66


class NoDeviceError(Error):
    """There is no usable Vulkan device."""
    status = 69


class OutputError(Error, OSError):
    """An output file cannot be created or was written incompletely."""
    status = 74


class TryAgainError(Error):
    """Out of memory, or the device was lost. Close all handles and try again."""
    status = 75


class Cancelled(Error):
    """The rendering was cancelled."""
    status = 130


class ClosedError(UsageError):
    """A handle was used after it was closed."""


_BY_STATUS = {kind.status: kind for kind in (
    UsageError, DataError, InputError, NoDeviceError, OutputError, TryAgainError, Cancelled)}
_BY_STATUS[73] = OutputError


def error_of(status: int, message: str) -> Error:
    """Returns the exception for a status, with a message."""
    error = _BY_STATUS.get(status, Error)(message or f'firn failed with status {status}')
    error.status = status
    return error
