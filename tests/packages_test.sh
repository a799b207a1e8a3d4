#!/usr/bin/env bash
# The Debian packages as a user finds them: an empty Debian 12, apt install, the case of README to a
# picture, a program of C++, a script of Python, billet-mpi. Needs root, and the system's own sources of apt.
#
# packages_test.sh FOLDER: with the packages; the empty Debian is kept in FOLDER/../empty for the next time.
set -euo pipefail
readonly source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
readonly packages=$(cd "$1" && pwd)
readonly empty=$(dirname "$packages")/empty
readonly root=$(mktemp -d --tmpdir="$(dirname "$packages")" tried.XXXX)
trap 'umount "$root/proc" 2>/dev/null || true; rm -rf --one-file-system "$root"' EXIT

say() { echo "packages_test: $*" >&2; }
inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
quietly() { "$@" &>"$root/log" || { tail -n 30 "$root/log" >&2; say "failed: $*"; exit 1; }; }

make_empty() {
  local mirror suite
  read -r mirror suite < <(apt-get indextargets --format '$(SITE) $(RELEASE)' | sort -u | head -n 1)
  say "an empty Debian $suite"
  rm -rf "$empty.part"
  debootstrap --variant=minbase "$suite" "$empty.part" "$mirror" >&2
  mv "$empty.part" "$empty"
}

same_sources() { # of apt, as this system has them
  cp -r /etc/apt/apt.conf.d /etc/apt/sources.list.d "$root/etc/apt/"
  [[ ! -s /etc/apt/sources.list ]] || cp /etc/apt/sources.list "$root/etc/apt/"
  cp /etc/resolv.conf /etc/hosts "$root/etc/"
  rm -f "$root/etc/apt/apt.conf.d/"*appstream* "$root/etc/apt/apt.conf.d/"*packagekit*
}

[[ -d $empty ]] || make_empty
cp -a "$empty/." "$root/"
same_sources
mount -t proc proc "$root/proc"
mkdir "$root/packages" "$root/work"
cp "$packages"/*.deb "$root/packages/"
quietly inside apt-get -q update

# README's case, from the package to a picture.
awk '/<!-- file: disk.toml -->/ { on = 1; next } on && /^```$/ { exit } on && !/^```/' "$source/README.md" >"$root/work/disk.toml"
start=$EPOCHREALTIME
quietly inside sh -c 'apt-get install -q -y /packages/billet_*.deb'
installed=$EPOCHREALTIME
inside sh -c 'cd /work && billet check disk.toml && billet run disk.toml --quiet && billet render results/disk && billet report results/disk'
end=$EPOCHREALTIME
[[ $(head -c 4 "$root/work/results/disk/von_mises.png" | tail -c 3) == PNG ]]
! inside sh -c 'command -v g++ cc' >/dev/null || { say "a compiler came along"; exit 1; }
awk -v start="$start" -v installed="$installed" -v end="$end" \
  'BEGIN { printf "packages_test: installed in %.1f s; case, picture and report in %.1f s\n", installed - start, end - installed }' >&2
say "size on disk: $(du -sm "$root" --exclude=proc | cut -f 1) MB, empty $(du -sm "$empty" | cut -f 1) MB"

# A case that came along, by the program for this processor.
inside sh -c 'cd /work && billet run /usr/share/billet/cases/upsetting-1018/case.toml --quiet && billet explain >/dev/null'
[[ -s $root/usr/share/billet/report.js && -s $root/usr/share/billet/docs/index.md ]]
ran=$(inside sh -c 'cd /work && billet run disk.toml --quiet -o results/slow --set time.increments.max=0.001 >/dev/null 2>&1 &
  sleep 1; readlink /proc/$!/exe; kill $!')
say "what ran: $ran"
if grep -qw avx2 /proc/cpuinfo; then [[ $ran == */x86-64-v3/billet ]]; fi

# Python.
quietly inside sh -c 'apt-get install -q -y --no-install-recommends /packages/python3-billet_*.deb'
inside sh -c 'cd /work && python3 -c "
import billet
last = None
for last in billet.Run(billet.Case.load(\"disk.toml\")): pass
print(billet.__version__, last.time, last.forces[\"die\"])
print(len(billet.results(\"results/disk\").history))"'

# Several processes.
quietly inside sh -c 'apt-get install -q -y --no-install-recommends /packages/billet-multigrid_*.deb openmpi-bin'
inside sh -c 'cd /work && OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpiexec --oversubscribe -n 2 billet-mpi run disk.toml --quiet -o results/two'
inside sh -c 'cd /work && billet run disk.toml --quiet --set solver.linear=multigrid -o results/multigrid && billet diff results/disk results/two --rtol 1e-6'

# A program of C++.
cp -r "$source/billet/example" "$root/work/"
quietly inside sh -c 'apt-get install -q -y --no-install-recommends /packages/libbillet-dev_*.deb g++ cmake make'
quietly inside sh -c 'cd /work && cmake -S example -B build && cmake --build build && build/upset disk.toml'

# What was installed goes without a trace.
quietly inside sh -c 'apt-get purge -q -y billet libbillet-dev billet-multigrid python3-billet'
left=$(inside find /usr /etc -path '*billet*' -not -path '*/__pycache__*' || true)
[[ -z $left ]] || { say "left behind: $left"; exit 1; }
say "all is well"
