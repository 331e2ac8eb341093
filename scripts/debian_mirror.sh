# shellcheck shell=sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Sourced by the other scripts: sets `debian_mirror` to where this system takes Debian's packages from, and
# `debian_keyring` to the keys that they are signed with.

# shellcheck disable=SC2016,SC2034 # apt expands REPO_URI; both are for who sources this
debian_mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Component: main' |
  grep --invert-match security | head -n 1)
debian_keyring=/usr/share/keyrings/debian-archive-keyring.gpg
