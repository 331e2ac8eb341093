# shellcheck shell=sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Sourced by the other scripts: prefers ninja, and sets `jobs` to what the processors and the memory allow.

if [ -z "${CMAKE_GENERATOR:-}" ] && command -v ninja >/dev/null; then
  export CMAKE_GENERATOR=Ninja
fi

# a compiler takes up to 4 GB on the tests of a room
# shellcheck disable=SC2034 # it is for who sources this
jobs=$(awk -v processors="$(nproc)" '/^MemAvailable:/ { fit = int($2 / 4e6) }
  END { print fit < 1 ? 1 : fit < processors ? fit : processors }' /proc/meminfo)
