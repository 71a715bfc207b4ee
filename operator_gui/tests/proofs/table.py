"""The table that a proof leaves: what must be zero, in a JSON file and in lines for a person."""
# SPDX-License-Identifier: Apache-2.0
import json


def finish(path, figures, counts, measured=()):
    """Write figures, the counts that must be 0, and rows of what was measured; the exit status says whether all is met.

    measured: name, unit, value and what it must be at most, None where nothing is asked.
    """
    rows = [{"name": name, "unit": "(count)", "value": value, "must": 0, "is_met": value == 0}
            for name, value in counts.items()]
    rows += [{"name": name, "unit": unit, "value": value, "must": most, "is_met": most is None or value <= most}
             for name, unit, value, most in measured]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps({**figures, "table": rows}, indent=2) + "\n", encoding="utf-8")
    for row in rows:
        wanted = "" if row["must"] is None else f"  at most {row['must']}: {'met' if row['is_met'] else 'NOT MET'}"
        print(f"{row['name']:<55} {row['value']:>8} {row['unit']}{wanted}")
    print(json.dumps(figures))
    return 0 if all(row["is_met"] for row in rows) else 1
