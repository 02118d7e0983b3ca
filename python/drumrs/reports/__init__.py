"""One page for each trade, made from a finished run: washer, dryer, mill, coater, and research, which has everything.

A page (`catalog`) is a question, a list of sections and what two dimensions cannot say to it. A section is a function
that gives sentences, tables and pictures (`content`) of a run (`run_data`); several pages share it: `power` and energy,
the `charge` in the drum, `contacts` and what they take, `laundry`, balance and mixing. `page` puts them into one file.
"""

from drumrs.reports.catalog import PAGES
from drumrs.reports.page import REPORT, report, require_page

__all__ = ["PAGES", "REPORT", "report", "require_page"]
