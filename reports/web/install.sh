#!/bin/sh
# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# install.sh NPM STAMP: what the lock file says, unless another build folder has just done it.
set -eu
npm=$1 stamp=$2
[ -f "$stamp" ] && [ "$stamp" -nt package-lock.json ] && [ "$stamp" -nt package.json ] && exit 0
"$npm" ci --ignore-scripts --no-audit --no-fund --loglevel=error
touch "$stamp"
