"""Numbers in the pages that come from stored tables: postprocess/README.md, "Numbers in pages", says how they are marked.

validation/CASE/claims.toml says what is read from which table, and `vibrotrough validate --claims --store` writes it into the pages.
"""

import ast
import math
import pathlib
import re
import tomllib
from typing import Any

from validation_case import read_table

Cell = float | str | None
Cells = dict[str, Cell]
MARK = re.compile(r"<!--=(?P<name>[^>]*?)-->(?P<text>.*?)<!--/-->", re.DOTALL)
PAGES = ("README.md", "src/*/README.md", "src/README.md", "src/manual/**/*.md", "tests/*/README.md", "postprocess/README.md", "validation/*/README.md")
KEYS = {"tables", "where", "base", "let", "value", "over", "text", "each", "join", "frame", "sort"}
FUNCTIONS = {"abs": abs, "min": min, "max": max, "round": round}
REWRITE = "'vibrotrough validate --claims --store' writes it"


class ClaimError(Exception):
    """A claim that cannot be read from its table."""


def _cell(text: str) -> Cell:
    """A number, a text, or nothing: what was not measured is empty or nan. The id of a case is a text, though it may be all digits."""
    if re.fullmatch("[0-9a-f]{12}", text):
        return text
    try:
        return float(text) if text and not math.isnan(float(text)) else None
    except ValueError:
        return text


def _column(name: str) -> str:
    """A column's name as expressions spell it: 'soft landing' is soft_landing."""
    return re.sub(r"\W+", "_", name)


def joined(paths: list[pathlib.Path]) -> list[Cells]:
    """The rows of the first table, with those of the further ones that have the same texts in the columns that both have."""
    rows: list[dict[str, str]] = read_table(paths[0])
    for path in paths[1:]:
        further = read_table(path)
        keys = [name for name in rows[0] if name in further[0]]
        by_key = {tuple(row[key] for key in keys): row for row in further}
        rows = [row | by_key[index] for row in rows if (index := tuple(row[key] for key in keys)) in by_key]
    return [{_column(name): _cell(text) for name, text in row.items()} for row in rows]


def _names(expression: str) -> set[str]:
    return {node.id for node in ast.walk(ast.parse(expression, mode="eval")) if isinstance(node, ast.Name)} - set(FUNCTIONS)


def _evaluate(expression: str, row: Cells) -> Any:
    missing = sorted(_names(expression) - set(row))
    if missing:
        raise ClaimError(f"there is no column '{missing[0]}'; the columns are {', '.join(row)}")
    try:
        return eval(compile(ast.parse(expression, mode="eval"), "claim", "eval"), {"__builtins__": {}} | FUNCTIONS, row)
    except (TypeError, ZeroDivisionError) as error:
        raise ClaimError(f"{expression} has no value in the row {row}: {error}") from error


def statistics(values: list[float]) -> dict[str, float]:
    """What `text` of a claim may quote of its values; `largest` is the one of the largest size, with its sign."""
    sizes = [abs(value) for value in values]
    return {"count": len(values), "mean": sum(values) / len(values), "rms": math.sqrt(sum(size * size for size in sizes) / len(values)),
            "least": min(values), "most": max(values), "largest": values[sizes.index(max(sizes))], "size": max(sizes),
            "mean_size": sum(sizes) / len(values)}


def claim_text(claim: dict[str, Any], folder: pathlib.Path) -> str:
    """What a claim says today."""
    unknown = sorted(set(claim) - KEYS)
    if unknown or "tables" not in claim or ("each" in claim) == ("text" in claim):
        raise ClaimError(f"needs the key tables, and either each or text; allowed are {', '.join(sorted(KEYS))}")
    rows = joined([folder / name for name in claim["tables"]])
    if "base" in claim:
        base = [row for row in rows if _evaluate(claim["base"], row)]
        if len(base) != 1:
            raise ClaimError(f"base must choose one row, not {len(base)}")
        rows = [row | {f"base_{name}": value for name, value in base[0].items()} for row in rows]
    chosen = [row for row in rows if _evaluate(claim.get("where", "True"), row)]
    for row in chosen:
        row |= {name: _evaluate(expression, row) for name, expression in claim.get("let", {}).items()}
    if "sort" in claim:
        chosen.sort(key=lambda row: _evaluate(claim["sort"], row))
    if not chosen and claim.get("text") != "{count}":
        raise ClaimError("no row of the table is chosen")
    try:
        if "each" in claim:
            each = str(claim.get("join", ", ")).join(claim["each"].format(**row) for row in chosen)
            return str(claim.get("frame", "{}")).format(each)
        used = _names(claim.get("value", "1")) | _names(claim.get("over", "1"))
        measured = [row for row in chosen if all(row.get(name, "") is not None for name in used)]
        values = [float(_evaluate(claim.get("value", "1"), row)) for row in measured]
        over = sum(float(_evaluate(claim.get("over", "1"), row)) for row in measured)
        return str(claim["text"]).format(**(statistics(values) | {"ratio": sum(values) / over} if values else {"count": 0}))
    except KeyError as error:
        raise ClaimError(f"there is no column or statistic {error}") from error
    except (ValueError, TypeError) as error:
        raise ClaimError(f"a value cannot be written so: {error}") from error


def all_claims(root: pathlib.Path) -> tuple[dict[str, str], list[str]]:
    """What each claim says by its name CASE.NAME, and what is wrong with those that cannot be read."""
    texts, problems = {}, []
    for path in sorted((root / "validation").glob("*/claims.toml")):
        for name, claim in tomllib.loads(path.read_text(encoding="utf-8")).items():
            try:
                texts[f"{path.parent.name}.{name}"] = claim_text(claim, path.parent)
            except (ClaimError, OSError, SyntaxError) as error:
                problems.append(f"{path.relative_to(root)}: [{name}]: {error}")
    return texts, problems


def pages(root: pathlib.Path) -> list[pathlib.Path]:
    return sorted({path for pattern in PAGES for path in root.glob(pattern)})


def numbers(text: str) -> int:
    """How many numbers with a decimal point a text has."""
    return len(re.findall(r"\d*\.\d+", text))


def wrong_marks(content: str, texts: dict[str, str]) -> list[str]:
    """What is wrong in one page whose claims should say `texts`."""
    problems = []
    if content.count("<!--=") != len(MARK.findall(content)):
        problems.append("a mark <!--=NAME--> without its end <!--/-->")
    if re.search(r"^ {0,3}<!--=[^>]*-->.", content, re.MULTILINE):
        problems.append("a mark begins a line, which Markdown then takes for HTML; move the line break")
    for mark in MARK.finditer(content):
        if mark["name"] not in texts:
            problems.append(f"there is no claim '{mark['name']}' that can be read")
        elif mark["text"] != texts[mark["name"]]:
            problems.append(f"{mark['name']} is '{mark['text']}', its table says '{texts[mark['name']]}'; {REWRITE}")
    return problems


def check(root: pathlib.Path) -> list[str]:
    """What is wrong: claims that cannot be read, marks without a claim, numbers that are not their table's, claims on no page."""
    texts, problems = all_claims(root)
    used = set()
    for page in pages(root):
        content = page.read_text(encoding="utf-8")
        used |= {mark["name"] for mark in MARK.finditer(content)}
        problems += [f"{page.relative_to(root)}: {problem}" for problem in wrong_marks(content, texts)]
    return problems + [f"no page quotes the claim '{name}'" for name in texts if name not in used]


def write(root: pathlib.Path) -> list[str]:
    """Writes all pages again; the names of those that have changed."""
    texts, _ = all_claims(root)
    changed = []
    for page in pages(root):
        old = page.read_text(encoding="utf-8")
        new = MARK.sub(lambda mark: f"<!--={mark['name']}-->{texts.get(mark['name'], mark['text'])}<!--/-->", old)
        if new != old:
            page.write_text(new, encoding="utf-8")
            changed.append(str(page.relative_to(root)))
    return changed


def summary(root: pathlib.Path) -> str:
    """How many numbers of each page come from tables, and how many others with a decimal point its prose has."""
    lines, total = [], 0
    for page in pages(root):
        content = re.sub(r"^ {4}.*$", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE)
        tied = sum(len(re.findall(r"\d+(?:\.\d+)?", mark["text"])) for mark in MARK.finditer(content))
        total += tied
        lines.append(f"{str(page.relative_to(root)):<46} {tied:>5} {numbers(MARK.sub('', content)):>7}")
    head = f"{'page':<46} {'tied':>5} {'others':>7}   (others: numbers with a decimal point, constants and inputs included)"
    return "\n".join([head, *lines, f"{total} numbers are tied to stored tables"])
