"""The studio as a widget: its own module in a page that stands for a notebook, over the messages of the real widget."""

import sys
import time

import pytest

import drumrs
from hosted import Notebook


@pytest.fixture
def widget():
    config = drumrs.baseline(fill=0.1, baffles=True).softer(100.0)
    widget = drumrs.widget(config)
    yield widget
    widget.close()


@pytest.fixture
def show(browser, widget):
    """Return a function that opens a page with the widget; at the end none may have complained or asked others."""
    opened = []

    def open_page() -> Notebook:
        context = browser.new_context(viewport={"width": 1200, "height": 1000})
        opened.append((Notebook(context, widget), context))
        return opened[-1][0]

    yield open_page
    for _, context in opened:
        context.close()
    assert [trouble for notebook, _ in opened for trouble in notebook.troubles] == []


def until(condition) -> None:
    deadline = time.monotonic() + 10.0
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.02)


def test_it_runs_once_it_is_seen_and_acts_as_the_page_does(show, widget):
    assert not widget.session.view.playing
    notebook = show()
    notebook.wait_for_time(0.3)
    assert notebook.part("title").inner_text() == "40 bundles (10 % fill), 3 baffles, 54 rpm, seed 1"
    assert notebook.part("preset").locator("option:checked").inner_text() == "your case"
    speed = notebook.page.locator("#one input[data-key='rotation.rpm']")
    speed.focus()
    notebook.page.keyboard.press("PageUp")
    notebook.wait("root.querySelector('.turning').textContent.startsWith('64.0')")
    assert widget.session.case().rotation.program[-1][1] == 64.0
    notebook.part("tile").first.wait_for()
    notebook.part("play").click()
    notebook.wait("!root.querySelector('.player').matches('.playing')")
    # The time that is written came as bytes, and is that of the simulation.
    stands = widget.session._simulation.time
    notebook.wait(f"root.querySelector('.time').textContent === '{stands:.2f} s'")
    notebook.part("one").click()
    notebook.until(lambda: widget.session._simulation.time > stands)
    fill = notebook.page.locator("#one input[data-key='load.fill']")
    fill.focus()
    notebook.page.keyboard.press("ArrowUp")
    notebook.wait("root.querySelector('.said').textContent.startsWith('Started anew')")
    assert notebook.part("time").inner_text() == "0.00 s"


def test_other_cells_change_what_is_seen(show, widget):
    notebook = show()
    notebook.wait_for_time(0.1)
    widget.session.pause()
    widget.session.change({"load.fill": 0.2})
    notebook.wait("root.querySelector('.title').textContent.startsWith('80 bundles')")


def test_what_is_refused_is_said_where_it_was_asked(show, widget):
    notebook = show()
    notebook.page.evaluate("void show('two')")
    notebook.wait_for_time(0.1)
    notebook.until(lambda: len(widget._pages) == 2)
    notebook.part("toml").click()
    notebook.part("case").wait_for()
    assert drumrs.Config.from_toml(notebook.part("case").input_value()).load.fill == 0.1
    # The other one shows the same drum, and no text that was not asked for there.
    assert notebook.part("case", "two").is_hidden()
    before = notebook.seconds("two")
    notebook.wait_for_time(before + 0.3)
    assert notebook.seconds("two") > before
    assert widget._responder.answer({"do": "set", "key": "load.fill", "value": 5}).keys() == {"kind", "text"}


def test_forces_come_to_the_page_that_asks_for_them(show, widget):
    notebook = show()
    notebook.page.evaluate("void show('two')")
    notebook.wait_for_time(0.1)
    notebook.part("forces").check()
    notebook.wait("root.querySelector('.layers').textContent.includes('normal force')")
    assert sorted(page.forces for page in widget._pages.values()) == [False, True]
    assert notebook.part("layers", "two").inner_text() == ""


def test_it_stands_still_while_no_page_asks(show, widget):
    first = show()
    first.wait_for_time(0.1)
    first.page.close()
    until(lambda: not widget.session.view.playing)
    stood = widget.session._simulation.time
    second = show()
    second.wait_for_time(stood + 0.1)
    assert widget.session.view.playing
    # Who paused it finds it so.
    second.part("play").click()
    second.until(lambda: not widget.session.view.playing)
    second.page.close()
    until(lambda: not any(page.is_there for page in widget._pages.values()))
    third = show()
    third.part("stage").wait_for()
    third.until(lambda: any(page.is_there for page in widget._pages.values()))
    assert not widget.session.view.playing


def test_a_widget_that_is_removed_leaves_nothing(show, widget):
    notebook = show()
    notebook.wait_for_time(0.1)
    assert notebook.page.evaluate(
        "dispose(), [listeners.size, document.querySelector('#one').innerHTML]"
    ) == [0, ""]
    notebook.page.wait_for_timeout(100)
    assert widget._pages == {}
    assert not widget.session.view.playing


def test_a_kernel_that_does_not_answer_is_said(show):
    notebook = show()
    notebook.wait_for_time(0.1)
    notebook.page.evaluate("void (busy = new Promise((resolve) => (answer = resolve)))")
    notebook.part("trouble").wait_for()
    assert notebook.part("trouble").inner_text().startswith("The kernel does not answer.")
    stood = notebook.seconds()
    notebook.page.evaluate("answer(), busy = null")
    notebook.wait_for_time(stood + 0.1)
    assert notebook.part("trouble").is_hidden()
    # A kernel that is gone stays so, whatever is asked of it.
    notebook.page.evaluate("dead = true")
    for _ in range(2):
        notebook.part("play").click()
        assert "run this cell again" in notebook.part("trouble").inner_text()
    notebook.page.evaluate("dispose()")


def test_keys_and_styles_stay_apart(show):
    notebook = show()
    notebook.wait_for_time(0.1)
    assert notebook.page.locator("p").first.evaluate("text => getComputedStyle(text).color") == "rgb(1, 2, 3)"
    assert notebook.part("facts").evaluate("text => getComputedStyle(text).color") != "rgb(1, 2, 3)"
    assert notebook.page.locator("head style").count() == 1
    notebook.part("stage").press("m")
    notebook.part("stage").press("q")
    assert notebook.part("mode").input_value() == "height"
    assert notebook.page.evaluate("keys") == ["q"]
    # JupyterLab looks no further than where it finds this, from where the key was pressed.
    assert notebook.page.evaluate("document.activeElement.dataset.lmSuppressShortcuts") == "true"


def test_it_begins_with_a_case_of_ones_own(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text("load.count = 7\n", encoding="utf-8")
    for given, name, count in (
        (None, "baseline", 100),
        (path, "mine.toml", 7),
        (drumrs.baseline(), "your case", 100),
    ):
        widget = drumrs.widget(given, seed=3)
        [start, *_] = widget._responder.news(widget.session.view, None)
        case = widget.session.case()
        assert (start["preset"], case.bundle_count, case.run.seed) == (name, count, 3)
        assert f"{case.title}>" in repr(widget)
        widget.close()
        widget.close()
        with pytest.raises(drumrs.DrumrsError, match="closed"):
            widget.session.play()
    with pytest.raises(drumrs.ConfigError, match="must be a Config"):
        drumrs.widget({"load.fill": 0.1})


def test_the_extra_is_named_where_it_is_missing(monkeypatch):
    monkeypatch.delitem(sys.modules, "drumrs.studio.notebook", raising=False)
    monkeypatch.setitem(sys.modules, "anywidget", None)
    with pytest.raises(drumrs.ConfigError, match=r"pip install 'drumrs\[notebook\]'"):
        drumrs.widget()
