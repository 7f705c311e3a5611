# An engine that falls silent at the query that starts at (5, ...), or at the second argument. It answers the others as
# odd_engine.py does, and starts faster, so that a short timeout is one for its silence only.
# $1: sleeps, or sleeps-buffered (it holds its answers back till the end), or closes-input, or stammers (it says
# everything twice, and never falls silent)
held=""
while read -r line; do
  case $line in *scene*) continue ;; esac
  id=${line#*:} && id=${id%%,*}
  k=${line#*\[} && k=${k%%,*}
  if [ "$k" = "${2:-5}" ] && [ "$1" != stammers ]; then
    [ "$1" = closes-input ] && exec <&-
    sleep 1000
  fi
  answer="{\"id\":$id,\"outcome\":\"hit\",\"lattice\":0,\"atom\":0,\"cell\":[$k,0],\"time\":$k}"
  if [ "$1" = sleeps-buffered ]; then
    held="$held$answer
"
  else
    echo "$answer"
    [ "$1" = stammers ] && echo "$answer"
  fi
done
printf %s "$held"
