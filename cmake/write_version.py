#!/usr/bin/env python3
"""Fills a template with the version and a digest of the engine, so that a result tells which engine made it.

The digest is that of what a compiler sees: comments, layout, the names of files and their includes do not change it.
"""
import argparse
import hashlib
import pathlib
import re

TOKEN = re.compile(
    r'''(?P<comment>//(?:\\\n|[^\n])*|/\*.*?\*/)
    |(?P<include>^[ \t]*\#[ \t]*(?:include\b[^\n]*|pragma[ \t]+once[ \t]*))
    |(?P<directive>^[ \t]*\#(?:\\\n|[^\n])*)
    |(?P<text>R"(?P<mark>[^\s()\\]*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\\n])*")
    |(?P<number>\.?[0-9](?:'[0-9a-zA-Z]|[eEpP][+-]|[0-9a-zA-Z_.])*)
    |(?P<character>'(?:\\.|[^'\\\n])*')
    |(?P<word>[^\W\d]\w*)
    |(?P<space>\s+)
    |(?P<sign>\.\.\.|->\*?|\+\+|--|::|&&|\|\||<<=?|>>=?|[-+*/%&|^!=<>]=|.)''', re.DOTALL | re.MULTILINE | re.VERBOSE)


def tokens(source):
    """What the compiler sees of a source: its tokens, without comments and includes."""
    for match in TOKEN.finditer(source):
        if match.lastgroup == 'directive':
            yield '\n' + ' '.join(tokens(re.sub(r'\\\n', ' ', match.group()).replace('#', '', 1))) + '\n'
        elif match.lastgroup not in ('comment', 'include', 'space'):
            yield match.group()


def digest(folder):
    """Eight hexadecimal digits for the sources below a folder, wherever they stand in it."""
    sources = sorted(path for pattern in ('*.h', '*.cpp') for path in pathlib.Path(folder).rglob(pattern))
    parts = sorted(hashlib.sha256('\0'.join(tokens(path.read_text('utf-8'))).encode()).hexdigest() for path in sources)
    return hashlib.sha256('\n'.join(parts).encode()).hexdigest()[:8]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ('engine', 'template', 'output', 'version'):
        parser.add_argument('--' + name, required=True)
    options = parser.parse_args()
    text = pathlib.Path(options.template).read_text('utf-8')
    text = text.replace('@BURNISH_VERSION@', options.version).replace('@BURNISH_ENGINE_DIGEST@', digest(options.engine))
    pathlib.Path(options.output).write_text(text, 'utf-8')


if __name__ == '__main__':
    main()
