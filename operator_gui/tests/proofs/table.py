"""The table that a proof leaves: what must be zero, in a JSON file and in lines for a person."""
# SPDX-License-Identifier: Apache-2.0
import json


def finish(path, figures, counts):
    """Write figures and the counts that must be 0; the exit status says whether they are."""
    rows = [{"name": name, "unit": "(count)", "value": value, "must": 0, "is_met": value == 0}
            for name, value in counts.items()]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps({**figures, "table": rows}, indent=2) + "\n", encoding="utf-8")
    for row in rows:
        print(f"{row['name']:<55} {row['value']:>8}  must be 0: {'met' if row['is_met'] else 'NOT MET'}")
    print(json.dumps(figures))
    return 0 if all(row["is_met"] for row in rows) else 1
