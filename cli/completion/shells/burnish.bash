# Completion of burnish in bash. The program says what can stand at the cursor.
_burnish() {
  COMPREPLY=()
  if [[ ${COMP_WORDS[COMP_CWORD]} == [~$]* ]]; then  # what only the shell knows
    compopt -o default
    return
  fi
  local candidate
  while IFS= read -r candidate; do
    COMPREPLY+=("$candidate")
  done < <("${1/#\~/$HOME}" complete --line "${COMP_LINE:0:COMP_POINT}" 2>/dev/null)
  if [[ -e ${COMPREPLY[0]} ]]; then compopt -o filenames; fi  # in quotes where they need them
  if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *[/=.] ]]; then compopt -o nospace; fi
}
complete -F _burnish burnish
