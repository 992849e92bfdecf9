"""The exception of the package."""
from typing import List, Optional, Sequence

from ._wrlkit import Message


class Error(RuntimeError):
    """Nothing could be made of a world. Its text is the message that the work has ended with, with file, line and column."""

    def __init__(self, text: str = '', message: Optional[Message] = None, messages: Sequence[Message] = ()) -> None:
        super().__init__(text)
        self._message, self._messages = message, list(messages)

    @property
    def message(self) -> Optional[Message]:
        """The message that the work has ended with, if there is one."""
        return self._message

    @property
    def messages(self) -> List[Message]:
        """All messages of the work."""
        return self._messages


Error.__module__ = 'wrlkit'  # where everybody finds it, pickle too
