"""Presets as text: an object or list stays on one line while it is short enough."""
import json

WIDTH = 118


def text_of(value, indent=0, prefix=0):
    flat = json.dumps(value, ensure_ascii=False)
    if len(flat) + indent + prefix <= WIDTH or not isinstance(value, (dict, list)):
        return flat
    pad = " " * (indent + 2)
    if isinstance(value, dict):
        rows = [f"{pad}{json.dumps(k)}: {text_of(v, indent + 2, len(k) + 4)}" for k, v in value.items()]
        return "{\n" + ",\n".join(rows) + "\n" + " " * indent + "}"
    if all(isinstance(v, (int, float)) for v in value):
        return "[\n" + filled([json.dumps(v) for v in value], pad) + "\n" + " " * indent + "]"
    return "[\n" + ",\n".join(pad + text_of(v, indent + 2) for v in value) + "\n" + " " * indent + "]"


def filled(words, pad):
    lines, line = [], pad
    for i, word in enumerate(words):
        word += "," if i + 1 < len(words) else ""
        if len(line) + len(word) + 1 > WIDTH and line.strip():
            lines.append(line.rstrip())
            line = pad
        line += word + " "
    return "\n".join(lines + [line.rstrip()])


def document(preset):
    return text_of(preset) + "\n"
