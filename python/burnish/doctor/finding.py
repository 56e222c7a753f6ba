"""One thing that the doctor found."""

from dataclasses import dataclass
from typing import Literal

Status = Literal["ok", "note", "missing", "failed"]


@dataclass
class Finding:
    """One line of the doctor's report."""

    name: str
    status: Status
    text: str
    remedy: str = ""

    def __str__(self) -> str:
        line = f"  [{self.status:^7}] {self.name}: {self.text}"
        return f"{line}\n{'':12}-> {self.remedy}" if self.remedy else line
