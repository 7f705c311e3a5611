# bash completion for lorentz. The program itself computes the completions.
_lorentz() {
  local word kind=words
  local -a answer
  mapfile -t answer < <("${COMP_WORDS[0]}" --complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
  COMPREPLY=()
  [ "${#answer[@]}" -gt 0 ] && kind=${answer[0]}
  for word in "${answer[@]:1}"; do
    COMPREPLY+=("${word%%$'\t'*}")
  done
  if [ "$kind" = files ]; then
    compopt -o filenames 2>/dev/null
    mapfile -t -O "${#COMPREPLY[@]}" COMPREPLY < <(compgen -f -- "${COMP_WORDS[COMP_CWORD]#=}")
  fi
}
complete -F _lorentz lorentz
