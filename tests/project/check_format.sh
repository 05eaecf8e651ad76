#!/usr/bin/env bash
# check_format.sh CLANG_FORMAT: succeeds if every C++ file has the format of .clang-format.
set -euo pipefail
cd "$(dirname "$0")/../.."
if find app core tests ui -name '*.[ch]pp' -print0 | xargs -0 "$1" --dry-run -Werror --ferror-limit=3; then
  exit 0
fi
echo "Some files are not in the project's format; ./dev format changes them."
exit 1
