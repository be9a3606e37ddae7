"""Reads the repository's documents and finds what in them does not fit the sources."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
GUIDE = ROOT / "docs" / "guide"


def documents():
    """All Markdown files for readers."""
    found = [ROOT / "README.md", ROOT / "CHANGELOG.md"]
    return found + sorted(ROOT.glob("docs/**/*.md")) + sorted(ROOT.glob("tools/*/README.md"))


def without_code(text):
    """The text without code blocks and code in lines: nothing in them is a link or a menu."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    text = re.sub(r"(?:^|\n)\n(?:    .*\n?|\n)+", "\n\n", text)
    return re.sub(r"`[^`\n]*`", "", text)


def anchors(text):
    """The anchors of the headings, as GitHub and MyST name them."""
    names = set()
    for heading in re.findall(r"^#{1,6} +(.+?) *$", text, flags=re.M):
        heading = re.sub(r"[`*]|\[|\]\([^)]*\)", "", heading).lower()
        name = re.sub(r"[^\w\- ]", "", heading).replace(" ", "-")
        unique, count = name, 0
        while unique in names:
            count += 1
            unique = f"{name}-{count}"
        names.add(unique)
    return names


def broken_links(text, file, made=()):
    """Targets of links that do not exist. `made`: files that may be missing, because a script makes them."""
    faults = []
    for target in re.findall(r"\]\(([^)\s]+)\)", without_code(text)):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        place = (file.parent / path).resolve() if path else file
        if not place.exists() and place not in made:
            faults.append(target)
        elif anchor and anchor not in anchors(place.read_text("utf-8") if path else text):
            faults.append(target)
    return faults


def window_texts():
    """The texts of the window, without the marks of keys and the dots of dialogs."""
    texts = set()
    for file in sorted(ROOT.glob("ui/**/*.cpp")):
        for text in re.findall(r'\btr\(\s*"((?:[^"\\]|\\.)*)"', file.read_text("utf-8")):
            texts.add(text.replace("&", "").rstrip("…"))
    return texts


def unknown_menus(text, texts):
    """Parts of menus such as ***File > Export data set*** that are no text of the window."""
    faults = []
    for menu in re.findall(r"\*\*\*([^*]+)\*\*\*", without_code(text)):
        faults += [part for part in re.split(r"\s*>\s*", " ".join(menu.split())) if part not in texts]
    return faults


def source_texts():
    """The string literals of the program; neighbours in a source are joined, as the compiler does."""
    texts = []
    for folder in ("core", "app", "ui"):
        for file in sorted(ROOT.glob(f"{folder}/**/*.[ch]*")):
            if file.suffix not in (".h", ".cpp"):
                continue
            for run in re.findall(r'(?:"(?:[^"\\\n]|\\.)*"\s*)+', file.read_text("utf-8")):
                texts.append("".join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', run)))
    return "\n".join(texts)


def unknown_messages(text, texts):
    """Messages in the first column of tables that the program does not have. `…` stands for names and numbers."""
    faults = []
    for message in re.findall(r"^\| `([^`]+)` \|", text, flags=re.M):
        if not all(part.strip() in texts for part in message.split("…")):
            faults.append(message)
    return faults


def made_pictures():
    """The pictures that make-pictures makes."""
    script = (GUIDE / "make-pictures").read_text("utf-8")
    return {GUIDE / "pictures" / f"{name}.png" for name in re.findall(r"^ *crop ([\w-]+)", script, flags=re.M)}


def shown_pictures():
    """The pictures that pages of the guide show."""
    shown = set()
    for page in GUIDE.glob("*.md"):
        for name in re.findall(r"!\[[^\]]+\]\((pictures/[^)]+)\)", page.read_text("utf-8")):
            shown.add(GUIDE / name)
    return shown
