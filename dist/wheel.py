"""Packs a tree as a wheel (PEP 427): a zip file, whose bytes depend on nothing but what is in it."""

import hashlib
import os
import sys
import time
import zipfile
from base64 import urlsafe_b64encode
from pathlib import Path

tree, version, platform, into = Path(sys.argv[1]), sys.argv[2], sys.argv[3], Path(sys.argv[4])
docs = tree / "share/doc/adit"
info, data = f"adit-{version}.dist-info", f"adit-{version}.data"
LICENCES = ["LICENSE-MIT", "LICENSE-APACHE", "THIRD-PARTY.txt"]

METADATA = f"""Metadata-Version: 2.4
Name: adit
Version: {version}
Summary: Tells a mobile robot which way to go and how to move
License-Expression: MIT OR Apache-2.0
{''.join(f"License-File: {name}{chr(10)}" for name in LICENCES)}Project-URL: Source, https://github.com/adit-robotics/adit
Requires-Python: >=3.8
Description-Content-Type: text/markdown

{(docs / "README.md").read_text()}"""

tags = "".join(f"Tag: py3-none-{tag}\n" for tag in platform.split("."))
WHEEL = f"Wheel-Version: 1.0\nGenerator: adit dist\nRoot-Is-Purelib: false\n{tags}"

files = {f"{data}/scripts/adit": (tree / "bin/adit").read_bytes()}
for file in sorted((tree / "share/man/man1").iterdir()):
    files[f"{data}/data/share/man/man1/{file.name}"] = file.read_bytes()
for name in LICENCES:
    files[f"{info}/licenses/{name}"] = (docs / name).read_bytes()
files[f"{info}/sboms/adit.cdx.json"] = (docs / "sbom.cdx.json").read_bytes()
files[f"{info}/METADATA"] = METADATA.encode()
files[f"{info}/WHEEL"] = WHEEL.encode()


def digest(content):
    return urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()


record = "".join(f"{name},sha256={digest(content)},{len(content)}\n" for name, content in files.items())
files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()

# zip files know no moment before 1980
moment = time.gmtime(max(int(os.environ["SOURCE_DATE_EPOCH"]), 315532800))[:6]
path = into / f"adit-{version}-py3-none-{platform}.whl"
with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as packed:
    for name, content in files.items():
        entry = zipfile.ZipInfo(name, moment)
        entry.external_attr = (0o100755 if "/scripts/" in name else 0o100644) << 16
        entry.compress_type = zipfile.ZIP_DEFLATED
        packed.writestr(entry, content)
print(path)
