#!/usr/bin/env python3
"""Checks that what the pages name exists: links and their headings, files, tests, and members written as Type::member.

usage: check_docs.py [ROOT]

Prints one line per fault and exits with 1 if there are any. Checked are README.md and the other pages at the root, docs/**/*.md and
benchmarks/page/sections.md (a part of docs/benchmarks.md). In all other sources only the names of pages are checked (docs/NAME.md).
docs/README.md must have a link to every page of docs.

A file name resolves if a file of the tree has that path or that end of a path: `frame.cpp`, `string/frame/frame.cpp`. Words in capital
letters and asterisks stand for anything: `presets/instruments/NAME.json`. Names without a suffix of source code are checked if they
begin with a folder of the tree; other names may be files of the reader (`song.mid`).
"""
import fnmatch
import os
import pathlib
import re
import sys

SOURCE_SUFFIX = r"(?:cpp|h|py|sh|cmake|csd)"
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
SOURCE_NAME = re.compile(rf"(?<![\w./<*-])([\w.*/-]*[\w*]\.{SOURCE_SUFFIX})(?![\w(])")
QUOTED = re.compile(r"`([^`\n]+)`")
TEST_NAME = re.compile(r"^[A-Z]\w*[a-z]\w*\.(?:[A-Z]\w*)?(?:\*|\.\.\.)?$")
CTEST_NAME = re.compile(r"^(?:live|peers|presets|benchmarks|docs|examples)\.[a-z]\w*(?:\.\*)?$")
TEST_FILE = re.compile(r"\b\w+_test\b(?!\.)")
IDENTIFIER = re.compile(r"`([a-z]+(?:_[a-z0-9]+)+)`")
MEMBER = re.compile(r"\b([A-Z]\w*)::([a-z_]\w*|[A-Z]\w*)\b")
PAGE_IN_SOURCE = re.compile(r"\bdocs/[\w/-]+\.md\b")
TYPE_HEAD = re.compile(r"\b(?:struct|class|enum class|namespace)\s+(\w+)[^;{}()]*\{")
DEFINED_TEST = re.compile(r"\b(?:TYPED_)?TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\s*\)")
IGNORED_FOLDERS = {".git", "build", "__pycache__", ".cache", "third_party"}
FOREIGN_TYPES = {"MoreauJeanBilbaoOSI"}


def tree(root):
    """Paths of all files, relative to the root, with forward slashes."""
    paths = []
    for folder, folders, files in os.walk(root):
        folders[:] = [f for f in folders if f not in IGNORED_FOLDERS]
        paths += [(pathlib.Path(folder) / f).relative_to(root).as_posix() for f in files if f != ".git"]
    return sorted(paths)


def headings(page):
    """The anchors that a page's headings get on GitHub."""
    anchors = []
    for title in re.findall(r"^#+ (.*)$", page, flags=re.M):
        slug = re.sub(r"[^\w\- ]", "", re.sub(r"`|\*", "", title.strip().lower())).replace(" ", "-")
        repeats = sum(a == slug or a.startswith(f"{slug}-") and a[len(slug) + 1:].isdigit() for a in anchors)
        anchors.append(f"{slug}-{repeats}" if slug in anchors else slug)
    return set(anchors)


def pattern_of(name):
    """NAME and * stand for anything."""
    return re.sub(r"(?<![a-z0-9_])[A-Z][A-Z_]+(?![a-z])", "*", name)


def members(code):
    """Type or namespace -> the words between its braces, over all definitions of that name."""
    found = {}
    code = re.sub(r"//[^\n]*", "", code)
    for head in TYPE_HEAD.finditer(code):
        depth, at = 1, head.end()
        for brace in re.compile(r"[{}]").finditer(code, head.end()):
            depth += 1 if brace[0] == "{" else -1
            if depth == 0:
                at = brace.start()
                break
        found.setdefault(head[1], set()).update(re.findall(r"\w+", code[head.end():at]))
    return found


class Tree:
    def __init__(self, root):
        self.root = root
        self.paths = tree(root)
        self.folders = {p for path in self.paths for p in map(str, pathlib.PurePosixPath(path).parents)}
        self.top = {path.split("/")[0] for path in self.paths if "/" in path}
        self.sources = {p: (root / p).read_text(encoding="utf-8", errors="replace") for p in self.paths
                        if re.search(rf"\.{SOURCE_SUFFIX}$|CMakeLists\.txt$", p)}
        code = "\n".join(text for path, text in self.sources.items() if path.endswith((".cpp", ".h")))
        self.words = set(re.findall(r"\w+", "\n".join(self.sources.values())))
        self.words |= {pathlib.PurePosixPath(path).stem for path in self.paths}
        self.members = {}
        for path, text in self.sources.items():
            if path.endswith(".h") or path.startswith("tests/") and path.endswith(".cpp"):
                for kind, words in members(text).items():
                    self.members.setdefault(kind, set()).update(words)
        self.tests = {f"{suite}.{name}" for suite, name in DEFINED_TEST.findall(code)}
        self.cmake = "\n".join(text for path, text in self.sources.items() if path.endswith("CMakeLists.txt"))

    def has(self, name):
        """Whether a file or folder has this path or, for sources, ends in it."""
        pattern = pattern_of(name.rstrip("/")).removeprefix("./")
        if name.endswith("/") or "/" in name and not re.search(r"\.\w+$", name):
            return any(fnmatch.fnmatchcase(folder, pattern) for folder in self.folders | set(self.paths))
        return any(fnmatch.fnmatchcase(path, pattern) or fnmatch.fnmatchcase(path, f"*/{pattern}") for path in self.paths)

    def has_test(self, name):
        pattern = name.replace("...", "*")
        return any(fnmatch.fnmatchcase(test, pattern if "*" in pattern else name) for test in self.tests)


def link_faults(root, base, page):
    for target in LINK.findall(page):
        if re.match(r"[a-z]+:", target):
            continue
        path, _, anchor = target.partition("#")
        file = (root / base / path) if path else None
        if file is not None and not file.exists():
            yield f"link to {target}: no such file"
        elif anchor and (file is None or file.suffix == ".md"):
            if anchor not in headings(page if file is None else file.read_text(encoding="utf-8")):
                yield f"link to {target}: no such heading"


def name_faults(tree_, page):
    text = LINK.sub(" ", page)
    for name in sorted(set(SOURCE_NAME.findall(text))):
        if not tree_.has(name):
            yield f"{name}: no such file"
    words = [word.rstrip(",;:)") for quoted in QUOTED.findall(text) for word in quoted.split()]
    words += [word.rstrip(",;:)") for line in re.findall(r"^    .*$", text, flags=re.M) for word in line.split()]
    for word in sorted(set(words)):
        first = word.split("/")[0]
        if "/" in word and first in tree_.top and re.fullmatch(r"[\w.*/-]+", word) and not SOURCE_NAME.fullmatch(word):
            if not tree_.has(word):
                yield f"{word}: no such file or folder"
        elif TEST_NAME.match(word) and not tree_.has_test(word):
            yield f"{word}: no such test"
        elif CTEST_NAME.match(word):
            parts = [part for part in word.split(".")[1:] if part != "*"]
            if not all(re.search(rf"\b{part}\b", tree_.cmake) for part in parts):
                yield f"{word}: no such test"
    for name in sorted(set(TEST_FILE.findall(text))):
        if not tree_.has(f"{name}.cpp"):
            yield f"{name}: no such test file"
    for word in sorted(set(IDENTIFIER.findall(text))):
        if word not in tree_.words:
            yield f"{word}: not a word of any source"
    for kind, member in sorted(set(MEMBER.findall(text))):
        if kind not in FOREIGN_TYPES and member not in tree_.members.get(kind, set()):
            yield f"{kind}::{member}: no such member"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent).resolve()
    tree_ = Tree(root)
    faults = []
    pages = [p for p in tree_.paths if p.endswith(".md") and ("/" not in p or p.startswith("docs/"))] + ["benchmarks/page/sections.md"]
    for path in pages:
        page = (root / path).read_text(encoding="utf-8")
        base = "docs" if path.startswith("benchmarks/") else pathlib.PurePosixPath(path).parent
        whole = (root / "docs/benchmarks.md").read_text(encoding="utf-8") if path.startswith("benchmarks/") else page
        inner = [f for f in link_faults(root, base, page) if not f.startswith("link to #")]
        inner += [f for f in link_faults(root, base, whole) if f.startswith("link to #")]
        faults += [f"{path}: {fault}" for fault in [*inner, *name_faults(tree_, page)]]
    index = (root / "docs/README.md").read_text(encoding="utf-8")
    faults += [f"docs/README.md: {path} is missing" for path in pages
               if path.startswith("docs/") and path != "docs/README.md" and f"({path.removeprefix('docs/')}" not in index]
    for path, text in tree_.sources.items():
        faults += [f"{path}: {page}: no such page" for page in sorted(set(PAGE_IN_SOURCE.findall(text)))
                   if "NAME" not in page and page not in tree_.paths]
    print("\n".join(faults) if faults else f"check_docs.py: {len(pages)} pages, all that they name exists")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
