"""The report of a finished study: one HTML page that an engineer can show around, and a summary in Markdown.

`headline`, `table1`, `checks`, `pictures` and `facts` make its parts, `page` puts them into `report.html.j2`, and
`summary` into a page of Markdown.
"""

from drumrs.paper.report.page import write
from drumrs.paper.report.pictures import Picture, Pictures

__all__ = ["Picture", "Pictures", "write"]
