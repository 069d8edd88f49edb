"""Every command of burnish on any page, in a block or between backticks, is one that there is, and has the options that stand behind it;
those that are complete, without anything that a reader has to fill in, are run by page_commands_test.py or say why not.

Usage: page_options_test.py BURNISH
"""

import pathlib
import re
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BLOCKS = re.compile(r"^```\w*\n(.*?)^```$|((?:^    [^\n]*\n)+)|`(burnish [^`]+)`", re.MULTILINE | re.DOTALL)
COMMAND = re.compile(r"(?:^|[\s`/\"'(])burnish ((?:-\w |--\w+ )*)([a-z]+)\b(.*)")
MARKED = re.compile(r"^(<!-- (?:run|(?:validate|not run): [^\n]*) -->\n)?\n((?:    [^\n]*\n)+)", re.MULTILINE)
WHOLE = re.compile(r" +(?:\$ |mpirun .*|\S*/)?burnish [a-z]")


def commands_on(text):
    """Each command with its options, of lines that end in a backslash or are indented further as one."""
    for block in BLOCKS.finditer(text):
        lines = next(part for part in block.groups() if part)
        joined = re.sub(r"\\?\n\s{12,}", " ", lines)
        # A command in quotes, as behind --on-frame, stands for itself.
        quoted = re.findall(r"'(burnish [^']*)'", joined)
        for line in re.sub(r"'burnish [^']*'", "", joined).splitlines() + quoted:
            line = re.split(r"\s#\s", line)[0]
            for part in re.split(r"\||&&|;", re.sub(r"(?<=\S)\|(?=\S)| \| (?=--)", " ", line)):
                found = COMMAND.search(part)
                if found:
                    yield found[2], re.findall(r"(?<![\w-])--[a-z][\w-]*", found[3])


def unmarked_on(text):
    """Complete commands, without dots, brackets and words in capitals, of indented blocks that are not marked."""
    for mark, block in MARKED.findall(text):
        for line in () if mark else block.splitlines():
            line = re.sub(r"'[^']*'|\"[^\"]*\"|\s#\s.*", "", line)
            if WHOLE.match(line) and not re.search(r"\.\.\.|[|\[]|\b[A-Z]{2,}\b", line):
                yield line.strip()


def main():
    burnish = sys.argv[1]
    known = {}
    wrong = []
    count = 0
    for page in [SOURCE / "README.md", *sorted(SOURCE.glob("docs/**/*.md"))]:
        text = page.read_text("utf-8")
        wrong += [f"{page.relative_to(SOURCE)}: {line}: put <!-- run -->, <!-- validate: WHY NOT RUN --> or <!-- not run: WHY --> before "
                  "its block, as page_commands_test.py says" for line in unmarked_on(text)]
        for command, options in commands_on(text):
            if command not in known:
                done = subprocess.run([burnish, command, "--help"], capture_output=True, text=True)
                known[command] = set(re.findall(r"--[a-z][\w-]*", done.stdout)) if done.returncode == 0 else None
            count += 1
            if known[command] is None:
                wrong.append(f"{page.relative_to(SOURCE)}: there is no command {command}")
                continue
            wrong += [f"{page.relative_to(SOURCE)}: {command} has no option {option}" for option in options
                      if option not in known[command]]
    if count < 150:
        wrong.append(f"{count} commands alone were found on the pages")
    print(*wrong, sep="\n")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
