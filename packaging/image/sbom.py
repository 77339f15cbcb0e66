"""What an image consists of, as SPDX 2.3 (JSON): packages, versions, licences."""

import datetime
import hashlib
import json
import re


def _licences(copyright_file):
    """The short names in a machine-readable debian/copyright; none where it is plain text."""
    if not copyright_file.is_file():
        return []
    text = copyright_file.read_text(errors="replace")
    if "Format:" not in text[:2000]:
        return []
    return sorted({name.strip() for name in re.findall(r"^License:[ \t]*(\S.*)$", text, re.MULTILINE)})


def write(file, *, board, version, when, packages, own_licence):
    """packages: Packages, with what was taken of Debian."""
    created = datetime.datetime.fromtimestamp(when, datetime.timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ")
    items = [{
        "SPDXID": "SPDXRef-lakshya", "name": "lakshya", "versionInfo": version, "downloadLocation": "NOASSERTION",
        "filesAnalyzed": False, "licenseConcluded": own_licence, "licenseDeclared": own_licence, "copyrightText": "NOASSERTION",
    }]
    for name, its_version in sorted(packages.taken.items()):
        deb = packages.file(name)
        found = _licences(packages.unpacked(name) / "usr/share/doc" / name / "copyright")
        items.append({
            "SPDXID": "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", name), "name": name, "versionInfo": its_version,
            "supplier": "Organization: Debian", "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
            "checksums": [{"algorithm": "SHA256", "checksumValue": hashlib.sha256(deb.read_bytes()).hexdigest()}],
            "licenseConcluded": "NOASSERTION", "licenseDeclared": "NOASSERTION",
            "licenseComments": "debian/copyright: " + (", ".join(found) if found else "no machine-readable list"),
            "copyrightText": "NOASSERTION",
            "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                              "referenceLocator": f"pkg:deb/debian/{name}@{its_version}?arch={packages.architecture}"}],
        })
    name = f"lakshya-{version}-{board}"
    document = {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": name,
        "documentNamespace": f"https://spdx.org/spdxdocs/{name}-{hashlib.sha256(json.dumps(items).encode()).hexdigest()[:16]}",
        "creationInfo": {"created": created, "creators": ["Tool: lakshya-image"]},
        "packages": items,
        "relationships": [{"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", "relatedSpdxElement": "SPDXRef-lakshya"}]
        + [{"spdxElementId": "SPDXRef-lakshya", "relationshipType": "DEPENDS_ON", "relatedSpdxElement": i["SPDXID"]} for i in items[1:]],
    }
    file.write_text(json.dumps(document, indent=1) + "\n")
