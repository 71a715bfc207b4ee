"""Links between the project's pages lead somewhere."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import re

import pytest

TOP = pathlib.Path(__file__).resolve().parents[2]
PAGES = sorted(path for pattern in ("*.md", "*/*.md", "docs/*/*.md", "catkin_ws/src/*/*.md", "firmware/*/*.md",
                                    "operator_gui/src/mtr_operator/*/*.md") for path in TOP.glob(pattern)
               if ".venv" not in path.parts and "out" not in path.relative_to(TOP).parts)


def anchors(page: pathlib.Path):
    """Names of a page's headings in links."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(TOP)))
def test_every_link_of_a_page_leads_somewhere(page):
    for target in re.findall(r"\]\(([^)\s]+)\)", page.read_text(encoding="utf-8")):
        if "://" in target:
            continue
        name, _, heading = target.partition("#")
        path = (page.parent / name).resolve() if name else page
        assert path.exists(), f"{target} is not there"
        assert not heading or heading in anchors(path), f"{target}: there is no such heading"
