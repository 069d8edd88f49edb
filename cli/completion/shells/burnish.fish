# Completion of burnish in fish. The program says what can stand at the cursor.
function __burnish_candidates
    set -l words (commandline -opc)
    set -l program (string replace -r '^~' $HOME -- $words[1])
    set -e words[1]
    $program complete -- $words "$(commandline -ct)" 2>/dev/null
end
complete -c burnish -f -a '(__burnish_candidates)'
