#!/bin/sh
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# get_libraries.sh DIR TARGET...: unpacks oneTBB and Highway for the targets (i386, arm64, armhf) below DIR, from the
# archives that this Debian system uses. Nothing is installed, and no root rights are needed.
set -eu
dir=$1
shift
for target in "$@"; do
    apt=$dir/apt/$target
    mkdir -p "$apt/lists/partial" "$apt/cache/archives/partial" "$apt/packages" "$dir/$target"
    touch "$apt/status"
    own="-o APT::Architecture=$target -o APT::Architectures=$target -o Dir::State::lists=$apt/lists
         -o Dir::State::status=$apt/status -o Dir::Cache=$apt/cache -o APT::Sandbox::User="
    # shellcheck disable=SC2086
    apt-get $own -q update || echo "an archive could not be read; going on with the others" >&2
    # shellcheck disable=SC2086
    (cd "$apt/packages" && apt-get $own -q download libtbb12 libtbbmalloc2 libtbbbind-2-5 libtbb-dev libhwy1 libhwy-dev)
    for package in "$apt"/packages/*.deb; do
        dpkg -x "$package" "$dir/$target"
    done
done
