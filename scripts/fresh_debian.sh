# shellcheck shell=sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Sourced by the other scripts: `make_debian SUITE` makes a fresh Debian in build/debian-SUITE, from the mirror of this
# one, and sets `root` to that; `in_debian COMMAND` runs a command in it, in /project. Needs root, and debootstrap.

# shellcheck source=scripts/debian_mirror.sh
. scripts/debian_mirror.sh

make_debian() {
  root=$PWD/build/debian-$1
  rm -rf --one-file-system "$root"
  mkdir -p "$root" build/debian-packages
  debootstrap --variant=minbase --force-check-gpg --keyring="$debian_keyring" \
    --cache-dir="$PWD/build/debian-packages" "$1" "$root" "$debian_mirror"

  # how this system reaches its mirror: proxies, names, certificates
  for file in /etc/apt/apt.conf.d /etc/apt/auth.conf /etc/apt/auth.conf.d /etc/resolv.conf /etc/hosts \
    /etc/ssl/certs/ca-certificates.crt /usr/local/share/ca-certificates; do
    [ ! -e "$file" ] || cp --recursive --dereference --parents "$file" "$root"
  done
  mkdir "$root/project"
}

# mounts and processes end with it
in_debian() {
  unshare --mount --pid --fork --kill-child --mount-proc="$root/proc" \
    chroot "$root" env --ignore-environment HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin \
    ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
    sh -c "cd /project && $1"
}
