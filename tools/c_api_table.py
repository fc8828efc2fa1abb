"""The C headers as a table: sections of enums, handles, structs and functions, each with its comment."""
import dataclasses
import re


@dataclasses.dataclass
class Member:
    """A field of a struct or an argument of a function. `calls` is the signature where it is a function."""
    name: str
    type: str  # "const petzval_pixels*", "int"
    doc: str = ""
    calls: "Function | None" = None


@dataclasses.dataclass
class Enum:
    name: str
    doc: str
    values: list  # (name, number, doc)


@dataclasses.dataclass
class Handle:
    name: str
    doc: str


@dataclasses.dataclass
class Struct:
    name: str
    doc: str
    fields: list


@dataclasses.dataclass
class Function:
    name: str
    returns: str
    arguments: list
    doc: str = ""


@dataclasses.dataclass
class Section:
    title: str
    preface: str
    items: list


@dataclasses.dataclass
class Api:
    sections: list

    def _all(self, kind):
        return [item for section in self.sections for item in section.items if isinstance(item, kind)]

    enums = property(lambda self: self._all(Enum))
    handles = property(lambda self: self._all(Handle))
    structs = property(lambda self: self._all(Struct))
    functions = property(lambda self: self._all(Function))


class Unreadable(Exception):
    """A declaration that does not keep the form of the headers."""


COMMENT = r"/\*(?:[^*]|\*(?!/))*\*/"


def _sentence(comment):
    """The text of /* … */ on one line, without the stars of its lines."""
    text = re.sub(r"^/\*|\*/$", "", comment.strip())
    return " ".join(re.sub(r"^\s*\* ?", "", line).strip() for line in text.splitlines()).strip()


def _typed(words):
    """("const void*", "data") of "const void* data", and of "void *data"."""
    found = re.fullmatch(r"(.*?[\s*])(\w+)", words.strip(), re.S)
    if not found:
        raise Unreadable(words)
    kind = re.sub(r"\s+", " ", found[1]).strip()
    return re.sub(r"\s*(\*+)$", r"\1", kind), found[2]


def _split(arguments):
    """Arguments at the commas that stand outside of brackets."""
    depth, parts = 0, [""]
    for letter in arguments:
        depth += {"(": 1, ")": -1}.get(letter, 0)
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts if part.strip() not in ("", "void")]


def _member(words, doc=""):
    function = re.fullmatch(r"(.+?)\(\*(\w+)\)\((.*)\)", words.strip(), re.S)
    if function:
        calls = Function(function[2], function[1].strip(), [_member(a) for a in _split(function[3])])
        return Member(function[2], "function", doc, calls)
    kind, name = _typed(words)
    return Member(name, kind, doc)


def _members(words, doc):
    """All of "void *r, *g, *b" and of "int width, height"."""
    if "(" in words:
        return [_member(words, doc)]
    first, *others = words.split(",")
    member = _member(first, doc)
    base = member.type.rstrip("*")
    made = [member]
    for other in others:
        stars = other.count("*")
        made.append(Member(other.replace("*", "").strip(), base + "*" * (stars or 0), doc))
    return made


def _fields(body):
    """A comment describes the members below it; behind a member on its line, that line's."""
    fields, waiting, pending = [], "", []
    for comment, statement in re.findall(rf"({COMMENT})|([^;/]+;)", body):
        if comment:
            if pending:
                for field in pending:
                    field.doc = (field.doc + " " + _sentence(comment)).strip()
                pending = []
            else:
                waiting = _sentence(comment)
            continue
        pending = _members(re.sub(r"\s+", " ", statement[:-1]).strip(), waiting)
        fields += pending
        waiting = ""
        if not _comment_follows(body, statement):
            pending = []
    return fields


def _comment_follows(body, statement):
    rest = body[body.index(statement) + len(statement):]
    return re.match(r"[ \t]*/\*", rest) is not None


def _values(body):
    number, values = -1, []
    for name, given, comment in re.findall(rf"(\w+)(?:\s*=\s*(\d+))?\s*,?\s*({COMMENT})?", body):
        number = int(given) if given else number + 1
        values.append((name, number, _sentence(comment) if comment else ""))
    return values


ITEM = re.compile(
    rf"(?P<comment>{COMMENT})"
    r"|typedef enum (?P<enum>\w+) \{(?P<values>.*?)\} (?P=enum);"
    r"|typedef struct (?P<handle>\w+) (?P=handle);"
    r"|typedef struct (?P<struct>\w+) \{(?P<fields>.*?)\} (?P=struct);"
    r"|PETZVAL_C_API (?P<returns>[^(]*?)(?P<function>petzval_\w+)\((?P<arguments>.*?)\);", re.S)


def _item(found, doc):
    if found["enum"]:
        return Enum(found["enum"], doc, _values(found["values"]))
    if found["handle"]:
        return Handle(found["handle"], doc)
    if found["struct"]:
        return Struct(found["struct"], doc, _fields(found["fields"]))
    returns = re.sub(r"\s+", " ", found["returns"]).strip()
    return Function(found["function"], returns, [_member(a) for a in _split(found["arguments"])], doc)


def _read(path, sections):
    text = path.read_text()
    start = text.index('extern "C" {')
    preface = _sentence(re.match(COMMENT, text)[0])
    sections.append(Section("", preface, []))
    doc, behind = "", None
    for found in ITEM.finditer(text, start):
        if found["comment"]:
            title = re.match(r"/\* --- (.*?)\s*(?:\* -+)?\s*\*/$", " ".join(found[0].split()))
            if title:
                sections.append(Section(title[1].strip(" -*/"), "", []))
            elif behind and "\n" not in text[behind.end():found.start()]:
                sections[-1].items[-1].doc = (sections[-1].items[-1].doc + " " + _sentence(found[0])).strip()
            else:
                doc = _sentence(found[0])
            behind = None
            continue
        sections[-1].items.append(_item(found, doc))
        doc, behind = "", found


def read(paths):
    """The table of these headers. Raises Unreadable for a declaration that does not keep their form."""
    sections = []
    for path in paths:
        _read(path, sections)
        declared = set(re.findall(r"^PETZVAL_C_API [^(]*?\b(petzval_\w+)\(", path.read_text(), re.M))
        missed = declared - {i.name for s in sections for i in s.items}
        if missed:
            raise Unreadable(f"{path.name}: {', '.join(sorted(missed))}")
    return Api([section for section in sections if section.items or section.preface])
