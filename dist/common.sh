# What the makers of packages share: where things lie, the version, and what goes into each package.
# Sourced by its neighbours; ADIT_PROGRAM=FILE packs that program instead of building one.
set -euo pipefail
# from where the command was given
[ -z "${ADIT_PROGRAM:-}" ] || ADIT_PROGRAM="$(realpath -m "$ADIT_PROGRAM")"
cd "$(dirname "${BASH_SOURCE[0]}")/.."

version="$(sed -n 's/^version = "\(.*\)"$/\1/p' Cargo.toml | head -n 1)"
machine="$(uname -m)"
made="${CARGO_TARGET_DIR:-target}/dist"
# the moment of the last commit, for whatever has to carry one: two builds of one commit are the same bytes
SOURCE_DATE_EPOCH="${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || echo 0)}"
export SOURCE_DATE_EPOCH
umask 022

said() { echo "dist/$(basename "$0"): $*" >&2; }

fail() {
    said "$*"
    exit 2
}

needs() {
    local tool
    for tool in "$@"; do
        command -v "$tool" >/dev/null || fail "the program \`$tool\` is missing; please install it first"
    done
}

# Whether a program needs no library of the machine.
is_static() {
    local headers
    headers="$(readelf --program-headers "$1")" || fail "$1 is no program for Linux"
    [[ "$headers" != *INTERP* ]]
}

# A tar file whose bytes depend on nothing but the files' names and contents.
tar_of() {
    tar --directory "$1" --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner \
        --format=gnu --create . | gzip --no-name -9
}

# The tree that every package holds: program, pages for man, completions, licences, notices, bill of materials.
stage() {
    local tree="$1" program docs
    program="${ADIT_PROGRAM:-}"
    if [ -z "$program" ]; then
        dist/binary --program
        program="$made/adit"
    fi
    [ -x "$program" ] || fail "there is no program \`$program\` to pack"
    rm -rf "$tree"
    docs="$tree/share/doc/adit"
    mkdir -p "$tree/bin" "$tree/share/man/man1" "$docs" "$tree/share/bash-completion/completions" \
        "$tree/share/zsh/site-functions" "$tree/share/fish/vendor_completions.d"
    strip --strip-all -o "$tree/bin/adit" "$program"
    "$tree/bin/adit" man "$tree/share/man/man1"
    gzip --no-name -9 "$tree"/share/man/man1/*.1
    "$tree/bin/adit" completions bash >"$tree/share/bash-completion/completions/adit"
    "$tree/bin/adit" completions zsh >"$tree/share/zsh/site-functions/_adit"
    "$tree/bin/adit" completions fish >"$tree/share/fish/vendor_completions.d/adit.fish"
    cp README.md CHANGELOG.md SECURITY.md LICENSE-MIT LICENSE-APACHE "$docs"
    dist/notices >"$docs/THIRD-PARTY.txt"
    dist/sbom >"$docs/sbom.cdx.json"
}
