#!/usr/bin/env bash
# Runs commands in a fresh clone of HEAD on a bare system, to show that they need nothing but what they install themselves.
# Usage, as root: scripts/check_bare.sh SUITE [COMMAND...]
#   SUITE: of Debian, such as bookworm or trixie; of Ubuntu with MIRROR=http://archive.ubuntu.com/ubuntu
#   COMMAND: one argument each; scripts/demo.sh and then scripts/test.sh unless told
# Goes on after a command that fails. The last lines say what was run, on what, and how long it took (docs/platforms.md).
# The system is made by debootstrap in a temporary folder (TMPDIR), which goes afterwards; KEEP=1 leaves it.
set -euo pipefail
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."

[[ $# -ge 1 && $1 != -* ]] || { echo "check_bare.sh: name a suite, such as trixie" >&2; exit 2; }
[[ $(id -u) == 0 ]] || { echo "check_bare.sh: only root may make a system" >&2; exit 1; }
command -v debootstrap > /dev/null || { echo "check_bare.sh: no debootstrap; apt-get install debootstrap" >&2; exit 1; }
suite=$1
shift
commands=("$@")
((${#commands[@]})) || commands=(scripts/demo.sh scripts/test.sh)
mirror=${MIRROR:-http://deb.debian.org/debian}

root=$(mktemp -d)
chmod 755 "$root"  # apt fetches as a user of its own
# Mounts are in a name space of their own (below) and gone by then.
trap '[[ -n ${KEEP:-} ]] && echo "check_bare: left in $root" || rm -rf --one-file-system "$root"' EXIT
start=$SECONDS
components=main
pockets=("$mirror" "$suite" "$mirror" "$suite-updates")
if [[ $mirror == */ubuntu* ]]; then
    components=main,universe
else
    pockets+=("$mirror-security" "$suite-security")
fi
debootstrap --variant=minbase --components="$components" "$suite" "$root" "$mirror" > "$root.log" || { cat "$root.log" >&2; exit 1; }
rm "$root.log"
printf "deb %s %s ${components/,/ }\n" "${pockets[@]}" > "$root/etc/apt/sources.list"
cp /etc/resolv.conf "$root/etc/resolv.conf"
cp /etc/apt/apt.conf.d/*proxy* "$root/etc/apt/apt.conf.d/" 2> /dev/null || true
printf '#!/bin/sh\nexit 101\n' > "$root/usr/sbin/policy-rc.d"  # no service starts here
chmod +x "$root/usr/sbin/policy-rc.d"
git clone --quiet --no-hardlinks . "$root/root/jawari"
commit=$(git rev-parse --short HEAD)
report=("debootstrap: $((SECONDS - start)) s")

# inside COMMAND: runs it in the clone; what it leaves running ends with it.
inside() {
    unshare --mount --propagation private --pid --fork --kill-child bash -c '
        mount --rbind /dev "$0/dev"
        mount -t proc proc "$0/proc"
        mount -t tmpfs tmpfs "$0/tmp"
        exec chroot "$0" env -i HOME=/root TERM=dumb LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin \
            ${http_proxy:+http_proxy="$http_proxy"} bash -c "cd /root/jawari && $1"' "$root" "$1" < /dev/null
}

failed=0
for command in "${commands[@]}"; do
    start=$SECONDS
    if inside "$command"; then
        report+=("$command: passed, $(((SECONDS - start) / 60)) min $(((SECONDS - start) % 60)) s")
    else
        report+=("$command: FAILED, $(((SECONDS - start) / 60)) min $(((SECONDS - start) % 60)) s")
        failed=1
    fi
done
printf '\n== Commit %s on %s (%s), %d processors, %s\n' "$commit" "$(. "$root/etc/os-release"; echo "$PRETTY_NAME")" \
    "$(inside 'c++ --version | head -n 1' || echo 'no compiler')" "$(nproc)" "$(date -u +%F)"
printf '%s\n' "${report[@]}"
exit "$failed"
