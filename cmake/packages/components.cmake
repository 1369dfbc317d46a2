# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The Rigor authors
#
# Read by cpack before it packs: the handbook is packed if it has been written (`cmake --build BUILD --target docs`).
if(NOT EXISTS ${CPACK_RIGOR_HANDBOOK}/index.html)
    list(REMOVE_ITEM CPACK_COMPONENTS_ALL documentation)
endif()
