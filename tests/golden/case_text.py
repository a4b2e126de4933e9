"""Case files put together from a body and options.

A text is a list of sections as in a case file. An option changes the sections before it:

    [body]              keys of this table are set; a key alone on its line is removed
    [[materials]]       one more table
    [[materials]] 2     keys of the second table are set
    -[[materials]]      all of these tables are removed, and so with -[stop]

Values stand on one line.
"""

import re

HEADER = re.compile(r"^(-?)(\[\[?)(\w+)\]\]?(?: (\d+))?$")


class CaseText:
    """Sections of a case: pairs of a header and a dictionary of keys and values as text."""

    def __init__(self):
        self.sections = [("", {})]

    def add(self, text):
        """Applies an option. Raises ValueError where a line has no meaning."""
        keys = self.sections[0][1]
        for line in (raw.strip() for raw in text.splitlines()):
            if not line or line.startswith("#"):
                continue
            header = HEADER.match(line)
            if header:
                keys = self._section(*header.groups())
            elif "=" in line:
                key, value = line.split("=", 1)
                keys[key.strip()] = value.strip()
            elif line in keys:
                del keys[line]
            else:
                raise ValueError(f"no key '{line}' to remove")
        return self

    def _section(self, minus, brackets, name, number):
        header = f"[[{name}]]" if brackets == "[[" else f"[{name}]"
        found = [keys for other, keys in self.sections if other == header]
        if minus:
            if not found:
                raise ValueError(f"no {header} to remove")
            self.sections = [pair for pair in self.sections if pair[0] != header]
            return {}
        if number:
            return found[int(number) - 1]
        if found and brackets == "[":
            return found[0]
        self.sections.append((header, {}))
        return self.sections[-1][1]

    def __str__(self):
        blocks = []
        for header, keys in self.sections:
            lines = [header] if header else []
            lines += [f"{key} = {value}" for key, value in keys.items()]
            if lines:
                blocks.append("\n".join(lines))
        return "\n\n".join(blocks) + "\n"
