"""Prints how many test cases of a JUnit report passed, failed and were skipped. usage: count_cases.py REPORT"""

import sys
import xml.etree.ElementTree as ElementTree


def count(root: ElementTree.Element) -> tuple[int, int, int]:
    passed = failed = skipped = 0
    for case in root.iter("testcase"):
        if case.find("failure") is not None or case.find("error") is not None:
            failed += 1
        elif case.find("skipped") is not None or case.get("status") in ("notrun", "disabled"):
            skipped += 1
        else:
            passed += 1
    return passed, failed, skipped


if __name__ == "__main__":
    print(*count(ElementTree.parse(sys.argv[1]).getroot()))
