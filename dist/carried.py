"""What the program carries of others: the packages that are linked into it, as cargo resolved them."""

import json
import os
import subprocess
import sys
import tomllib
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent


def metadata():
    """What cargo knows of the workspace on this machine's target."""
    cargo = os.environ.get("CARGO", "cargo")
    host = next(
        line.removeprefix("host: ")
        for line in subprocess.run(["rustc", "-vV"], cwd=TOP, check=True, capture_output=True, text=True).stdout.splitlines()
        if line.startswith("host: ")
    )
    command = [cargo, "metadata", "--locked", "--format-version", "1", "--filter-platform", host]
    done = subprocess.run(command, cwd=TOP, stdout=subprocess.PIPE)
    if done.returncode != 0:
        sys.exit(f"{Path(sys.argv[0]).name}: cargo cannot say what the program is made of (see above)")
    return json.loads(done.stdout)


def linked(root="adit"):
    """The root package, and all that is linked into it: package and the ids of those it needs, in the order of names.

    What only tests or build scripts need is no part of it; macros are counted, since what they write is.
    """
    found = metadata()
    packages = {package["id"]: package for package in found["packages"]}
    needs = {
        node["id"]: sorted(
            dependency["pkg"]
            for dependency in node["deps"]
            if any(kind["kind"] is None for kind in dependency["dep_kinds"])
        )
        for node in found["resolve"]["nodes"]
    }
    top = next(id for id in found["workspace_members"] if packages[id]["name"] == root)
    reached, open_ = {top}, [top]
    while open_:
        for id in needs[open_.pop()]:
            if id not in reached:
                reached.add(id)
                open_.append(id)
    order = sorted(reached, key=lambda id: (packages[id]["name"], packages[id]["version"]))
    return packages[top], [(packages[id], needs[id]) for id in order]


def checksums():
    """SHA-256 of the packages as they were published, by name and version."""
    lock = tomllib.loads((TOP / "Cargo.lock").read_text())
    return {(package["name"], package["version"]): package["checksum"] for package in lock["package"] if "checksum" in package}
