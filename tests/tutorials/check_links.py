"""Every link of a page of the project leads to a file, and to a heading where it names one.

usage: check_links.py FOLDER
"""

import re
import sys
from functools import cache
from pathlib import Path
from urllib.parse import unquote

LINK = re.compile(r"\]\(([^()\s]+(?:\([^()\s]*\)[^()\s]*)*)(?:\s+\"[^\"]*\")?\)")


def without_code(text):
    return re.sub(r"(?ms)^```.*?^```", "", text)


@cache
def anchors(page):
    """Names of the headings of a page, as GitHub makes them, and of its <a id>."""
    text = without_code(page.read_text(encoding="utf-8"))
    names = re.findall(r'<a id="([^"]+)"', text)
    for heading in re.findall(r"(?m)^#+ +(.+?) *$", text):
        words = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").lower()
        names.append(re.sub(r"[^\w\- ]", "", words).replace(" ", "-"))
    return names


def fault_of(page, link):
    path, _, anchor = link.partition("#")
    target = (page.parent / unquote(path)).resolve() if path else page
    if not target.exists():
        return "no such file"
    if anchor and target.suffix == ".md" and anchor not in anchors(target):
        return "no such heading"
    return None


def main(folder):
    root = Path(folder).resolve()
    pages = [root / "README.md", *(page for part in ("docs", "meshes", "verification")
                                   for page in sorted((root / part).rglob("*.md")))]
    faults, links = [], 0
    for page in pages:
        for link in LINK.findall(without_code(page.read_text(encoding="utf-8"))):
            if re.match(r"\w+:", link):
                continue  # of the network
            links += 1
            if fault := fault_of(page, link):
                faults.append(f"{page.relative_to(root)}: {link}: {fault}")
    print("\n".join(faults) or f"{links} links of {len(pages)} pages")
    return 1 if faults or not links else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
