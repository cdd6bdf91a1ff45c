#!/usr/bin/env bash
# Tells Snakemake how a Slurm job is: running, success or failed. Needs no accounting database.
set -euo pipefail

state=$(scontrol -o show job "$1" 2> /dev/null | grep -oP 'JobState=\K\S+' || true)
if [[ -z $state ]]; then  # the controller has forgotten it: ask the database, if there is one
  state=$(sacct -X -n -P -o State -j "$1" 2> /dev/null | head -n 1 || true)
fi
case $state in
  COMPLETED) echo success ;;
  PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | RESIZING | REQUEUED*) echo running ;;
  *) echo failed ;;
esac
