#!/usr/bin/env python3
"""Markdown table on standard input -> CSV on standard output; other lines are dropped."""
import csv
import sys

writer = csv.writer(sys.stdout, lineterminator="\n")
for line in sys.stdin:
    cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
    if line.startswith("|") and set(line.strip()) != {"|", "-"}:
        writer.writerow(cells)
