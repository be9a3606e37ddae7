#!/usr/bin/env bash
# The surroundings of the program: caches that cannot be written or are damaged, signals, limits, odd arguments.
. "$(dirname "${BASH_SOURCE[0]}")/lib.sh"
export XDG_CACHE_HOME=$work/cache TMPDIR=$work/tmp
mkdir "$TMPDIR"
two_frames=(scan demo --frames 2 --overwrite)

# Compiled kernels: no folder to keep them in, damaged ones.
says "HOME that cannot be written" "compiled anew" env -u XDG_CACHE_HOME HOME=/proc "$program" devices
says "HOME that cannot be written leaves the processor" "[0]" env -u XDG_CACHE_HOME HOME=/proc "$program" devices
says "a cache folder that cannot be written" "compiled anew" env XDG_CACHE_HOME=/proc "$program" devices
says "an empty POCL_CACHE_DIR" "[0]" env POCL_CACHE_DIR= "$program" devices
says "a device that PoCL lacks" "POCL_DEVICES" env POCL_DEVICES=nonsense "$program" devices
succeeds "a scan" "$program" "${two_frames[@]}" --out kernels
kernels=$XDG_CACHE_HOME/scantrove/kernels
holds "compiled kernels are kept" test -d "$kernels"
cp -r "$kernels" "$work/given"
find "$kernels" -name '*.so' -exec truncate -s 0 {} +
says "empty kernels" "damaged" "$program" "${two_frames[@]}" --out kernels
find "$kernels" -name '*.bc' -exec dd if=/dev/zero of={} bs=1 seek=5000 count=3000 conv=notrunc status=none \;
says "kernels with zeros" "damaged" "$program" "${two_frames[@]}" --out kernels
find "$work/given" -name '*.bc' -exec sh -c 'echo garbage >"$1"' - {} \;
says "garbage in a folder of others" "Remove that folder" \
  env POCL_CACHE_DIR="$work/given" "$program" "${two_frames[@]}" --out kernels
holds "files of others stay" sh -c 'grep -rqx garbage given'
holds "nothing is left in TMPDIR" sh -c '! ls tmp | grep -q kernels'

finish
