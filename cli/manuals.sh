#!/bin/sh
# Manual pages of the program and of each subcommand, from what --help says, by help2man.
#
# usage: manuals.sh PROGRAM VERSION FOLDER
set -eu
program=$1 version=$2 folder=$3
here=$(dirname "$0")
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
mkdir -p "$folder"
rm -f "$folder"/lorentz*.1

page() { # page NAME WORDS..: of `lorentz WORDS..`, and of its subcommands
  name=$1
  shift
  # help2man takes a page's name from a command without words of its own.
  printf '#!/bin/sh\nexec "%s" %s "$@"\n' "$program" "$*" >"$scratch/$name"
  chmod +x "$scratch/$name"
  "$scratch/$name" --help >"$scratch/help"
  about=$(sed -n '1s/\.$//p' "$scratch/help")
  commands=$(sed -n '/^Subcommands:/,/^$/s/^  \([a-z][a-z-]*\) .*/\1/p' "$scratch/help")
  help2man --no-info --manual lorentz --name "$about" --version-string "$version" --include "$here/manuals.h2m" \
    --output "$folder/$name.1" "$scratch/$name"
  for command in $commands; do (page "$name-$command" "$@" "$command"); done
}
page lorentz
