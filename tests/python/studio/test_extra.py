"""Without the extra the studio says in one sentence how to get it."""

import sys


def test_the_extra_is_named_where_it_is_missing(drum, monkeypatch):
    monkeypatch.delitem(sys.modules, "drumrs.studio.server", raising=False)
    monkeypatch.setitem(sys.modules, "starlette.applications", None)
    monkeypatch.setitem(sys.modules, "uvicorn", None)
    status, out, err = drum("studio", "--no-open")
    assert (status, out) == (2, "")
    assert "pip install 'drumrs[studio]'" in err
    assert len(err.splitlines()) == 1
