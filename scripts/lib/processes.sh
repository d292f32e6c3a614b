# Sourced by the scripts beside this folder: starts processes in groups of their own and ends them, and nothing else.
# shellcheck shell=bash

readonly END_GRACE_SECONDS=15  # from a polite signal to a hard one: a recording may still have to be written
readonly START_SECONDS_MAX=60  # until a server listens
started_pids=()
# Every process that comes of `start` carries this in its environment, wherever it moves.
export URTO_RUN_ID="$$-${EPOCHREALTIME//[.,]/}"

# start COMMAND…: in the background, as the leader of its own process group, so that a Ctrl-C at the terminal reaches
# only this script, which then ends the groups in order. Sets started to its process id.
start() {
  set -m
  "$@" </dev/null &
  started=$!
  set +m
  started_pids+=("$started")
}

running() { kill -0 "$1" 2>/dev/null; }

port_taken() { (exec 3<>"/dev/tcp/127.0.0.1/$1") 2>/dev/null; }

# wait_for_port PID PORT: until the process listens; fails if it ends before.
wait_for_port() {
  local deadline=$((SECONDS + START_SECONDS_MAX))
  until port_taken "$2"; do
    running "$1" || return 1
    [ "$SECONDS" -lt "$deadline" ] || return 1
    sleep 0.1
  done
}

# first_of PID…: waits until one of them ends; its status.
first_of() {
  local status=0
  wait -n "$@" || status=$?
  return "$status"
}

# The ids of the processes that carry our mark, this script and its own subshells left out.
marked_processes() {
  local folder pid
  for folder in /proc/[0-9]*; do
    pid=${folder#/proc/}
    [ "$pid" != "$$" ] && [ "$pid" != "$BASHPID" ] || continue
    tr '\0' '\n' <"$folder/environ" 2>/dev/null | grep -qxF "URTO_RUN_ID=$URTO_RUN_ID" && echo "$pid"
  done 2>/dev/null
  return 0
}

# Ends the groups that were started, the last one first, and whatever left its group (a viewer does).
end_all() {
  local index pid deadline left
  trap - EXIT
  trap '' INT TERM HUP
  for ((index = ${#started_pids[@]} - 1; index >= 0; index--)); do
    pid=${started_pids[index]}
    kill -INT -- "-$pid" 2>/dev/null || continue  # as Ctrl-C would: recordings are finished, viewers closed
    deadline=$((SECONDS + END_GRACE_SECONDS))
    while kill -0 -- "-$pid" 2>/dev/null && [ "$SECONDS" -lt "$deadline" ]; do sleep 0.05; done
    kill -KILL -- "-$pid" 2>/dev/null || true
  done
  left=$(marked_processes)
  # shellcheck disable=SC2086  # a list of numbers
  [ -z "$left" ] || kill -TERM $left 2>/dev/null || true
  wait 2>/dev/null || true
}

# From here on whatever was started ends with this script, however that ends.
end_all_at_exit() {
  trap 'end_all' EXIT
  trap 'printf "\n"; say "Ending"; exit 130' INT
  trap 'exit 143' TERM
  trap 'exit 129' HUP
}
