#!/usr/bin/env python3
"""Writes what lets a program load shared libraries by the first call of one of their functions, as assembler of x86-64.

Of the functions that the program's archives call, those of the libraries and those of one more archive, which is to be
loaded with them, get

- stubs, which the program links in their place: each jumps to where its slot points. At first that is a piece of code that calls
  `burnish_load_late_functions` (cli/vtk_loader.cpp), which fills the slots, and goes on to the function then;
- a table of their addresses in the same order, which is linked into what is loaded. Its name holds a digest of the functions and of the
  one archive: a program does not take the table of another build.

What VTK's headers run when a file that includes them begins and ends, to count such files, does nothing in the program: the libraries
count their own.

Only functions can be late: a variable, a table of virtual functions or type information of a library ends with an error, and so
does what none of the libraries has.
"""
import argparse
import hashlib
import pathlib
import re
import subprocess
import sys

# Keeps the registers that hold arguments. The stack is at a multiple of 16 where another function is called.
ARGUMENTS = ['rax', 'rdi', 'rsi', 'rdx', 'rcx', 'r8', 'r9']
VECTORS = 8
FIRST_CALL = '\n'.join([
    '  .type first_call, @function', 'first_call:', '  .cfi_startproc', '  .cfi_adjust_cfa_offset 8',
    *(f'  push %{name}\n  .cfi_adjust_cfa_offset 8' for name in ARGUMENTS),
    f'  sub ${16 * VECTORS + 8}, %rsp\n  .cfi_adjust_cfa_offset {16 * VECTORS + 8}',
    *(f'  movups %xmm{k}, {16 * k}(%rsp)' for k in range(VECTORS)),
    '  call burnish_load_late_functions',
    *(f'  movups {16 * k}(%rsp), %xmm{k}' for k in range(VECTORS)),
    f'  add ${16 * VECTORS + 8}, %rsp\n  .cfi_adjust_cfa_offset -{16 * VECTORS + 8}',
    *(f'  pop %{name}\n  .cfi_adjust_cfa_offset -8' for name in reversed(ARGUMENTS)),
    '  pop %r11\n  .cfi_adjust_cfa_offset -8', '  lea burnish_late_functions(%rip), %r10', '  jmp *(%r10,%r11,8)',
    '  .cfi_endproc', '  .size first_call, .-first_call', ''])
COUNTERS = re.compile(r'_ZN\d+vtk\w*(Manager|Cleanup)[CD][12]Ev')
END = '  .section .note.GNU-stack, "", @progbits\n'


def symbols(nm, file, *options):
    """Names and kinds (of nm) of the symbols of a file."""
    listed = subprocess.run([nm, '--format=posix', *options, file], check=True, capture_output=True, text=True).stdout
    rows = (line.split() for line in listed.splitlines())
    return [(row[0].split('@')[0], row[1]) for row in rows if len(row) > 1 and len(row[1]) == 1]


def late_functions(arguments):
    defined, called = set(), set()
    for archive in arguments.callers:
        for name, kind in symbols(arguments.nm, archive):
            (called if kind == 'U' else defined).add(name)
    kinds = {}
    for library in arguments.libraries:
        kinds.update(symbols(arguments.nm, library, '--dynamic', '--defined-only'))
    own = [name for name, kind in symbols(arguments.nm, arguments.archive, '--defined-only') if kind == 'T']
    wanted = sorted(name for name in called - defined - set(own) if 'vtk' in name)
    problems = [f'{name} is in no component of find_package(VTK)' for name in wanted if name not in kinds]
    problems += [f'{name} is no function: what needs it belongs to {pathlib.Path(arguments.archive).stem} (docs/architecture.md)'
                 for name in wanted if kinds.get(name, 'T') not in 'TWi' or name.startswith('_ZT')]
    if problems:
        sys.exit('\n'.join(f'late_functions: {problem}' for problem in problems))
    return sorted({*own, *wanted})


def stubs(functions, counters, table):
    """The functions as the program links them."""
    lines = ['  .text', FIRST_CALL]
    for name in counters:
        lines += [f'  .globl {name}', f'  .type {name}, @function', f'{name}:', '  ret', f'  .size {name}, .-{name}']
    for k, name in enumerate(functions):
        lines += [f'  .globl {name}', f'  .type {name}, @function', f'{name}:', f'  jmp *burnish_late_functions+{8 * k}(%rip)',
                  f'first_{k}:', f'  push ${k}', '  jmp first_call', f'  .size {name}, .-{name}']
    lines += ['  .data', '  .balign 8', '  .globl burnish_late_functions', 'burnish_late_functions:',
              *(f'  .quad first_{k}' for k in range(len(functions))), '  .section .rodata',
              '  .globl burnish_late_table', 'burnish_late_table:', f'  .asciz "{table}"', '  .balign 8',
              '  .globl burnish_late_count', 'burnish_late_count:', f'  .quad {len(functions)}', END]
    return '\n'.join(lines)


def addresses(functions, table):
    """The table of the library that is loaded."""
    return '\n'.join(['  .section .data.rel.ro, "aw"', '  .balign 8', f'  .globl {table}', f'{table}:',
                      *(f'  .quad {name}' for name in functions), END])


def write(file, text):
    """What has not changed is not assembled again."""
    if not file.exists() or file.read_text() != text:
        file.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--nm', required=True)
    parser.add_argument('--callers', nargs='+', required=True, help='archives of the program')
    parser.add_argument('--archive', required=True, help='what is loaded with the libraries')
    parser.add_argument('--libraries', nargs='+', required=True)
    parser.add_argument('--stubs', type=pathlib.Path, required=True)
    parser.add_argument('--table', type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    found = late_functions(arguments)
    functions = [name for name in found if not COUNTERS.fullmatch(name)]
    counters = [name for name in found if COUNTERS.fullmatch(name)]
    build = '\n'.join(functions).encode() + pathlib.Path(arguments.archive).read_bytes()
    table = 'burnish_late_' + hashlib.sha256(build).hexdigest()[:16]
    write(arguments.stubs, stubs(functions, counters, table))
    write(arguments.table, addresses(functions, table))


main()
