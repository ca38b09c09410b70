#!/usr/bin/env python3
"""Counts the tests that CTest skipped and says why, from its --output-junit file.

usage: skipped_tests.py FILE
"""
import collections
import re
import sys
import xml.etree.ElementTree

# What a test says: Python's "skipped: REASON", or GoogleTest's line after the place of GTEST_SKIP().
REASON = re.compile(r"^(?:skipped|SKIPPED): (.*)$|^\S+:\d+: Skipped\n(.*)$", re.MULTILINE)


def main():
    by_reason = collections.defaultdict(list)
    for case in xml.etree.ElementTree.parse(sys.argv[1]).iter("testcase"):
        skipped = case.find("skipped")  # or a program that is not there, which CTest counts as failed
        if skipped is not None and skipped.get("message", "").startswith("SKIP_"):
            found = REASON.search(case.findtext("system-out") or "")
            by_reason[(found[1] or found[2]) if found else "no reason given"].append(case.get("name"))
    print(f"{sum(map(len, by_reason.values()))} tests skipped")
    for reason, names in sorted(by_reason.items()):
        print(f"  {reason}: {' '.join(names)}")


if __name__ == "__main__":
    main()
