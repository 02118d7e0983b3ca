"""The report of a finished study: one HTML page that an engineer can show around, and a summary in Markdown.

`findings` is what it tells of; `headline`, `table1`, `checks`, `pictures`, `players` and `facts` make its parts, and
`page` puts them into `report.html.j2`, `summary` into a page of Markdown.
"""

from drumrs.report.findings import Findings
from drumrs.report.page import write
from drumrs.report.pictures import Picture

__all__ = ["Findings", "Picture", "write"]
