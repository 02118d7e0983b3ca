"""Bad input gets one sentence with key, value and limit, status 2, no traceback, and writes nothing."""

import hashlib

import pytest

import drumrs
from drumrs.errors import CheckpointError, ConfigError

NAN, INF = "nan", "inf"


def numbers(*keys: str) -> list[tuple[str, str]]:
    """Each key with the values that no length, mass or time can have."""
    return [(f"{key}={value}", key) for key in keys for value in ("-1.0", "0", NAN, INF)]


# What is set, and what the sentence must name.
SETTINGS = [
    *numbers(
        "drum.diameter",
        "load.diameter",
        "load.density",
        "contact.bundle.normal_stiffness",
        "contact.drum.normal_stiffness",
        "run.time_step",
        "run.duration",
    ),
    ("contact.bundle.frictoin=0.3", "did you mean contact.bundle.friction?"),
    ("contact.bundle.restitution=0", "above 0 and at most 1"),
    ("contact.drum.restitution=1.5", "above 0 and at most 1"),
    ("contact.drum.restitution=nan", "above 0 and at most 1"),
    ("contact.bundle.friction=-0.1", "at least 0"),
    ("contact.drum.tension=perhaps", "'allowed' or 'clipped'"),
    ("load.fill=1.2", "load.fill is 1.2 (480 bundles), but must be at most 0.825 (330 bundles)"),
    ("load.fill=25", "no more of them fit into this drum; a fill of 25 % is 0.25"),
    ("load.count=500", "load.count is 500, but must be at most"),
    ("load.count=0", "from 1"),
    ("load.count=10.5", "load.count is 10.5, but must be a whole number"),
    (
        "load.fill=0,25",
        "load.fill is '0,25', but must be a positive finite number; write 0.25",
    ),
    ("load.count=1,000", "from 1 to 10000000; write 1000"),
    ("load.diameter=23.75mm", "write a number alone, without 'mm', in "),
    ("rotation.rpm=54 rpm", "write a number alone, without 'rpm', in "),
    ("run.window=5,15", "run.window is '5,15', but must be a pair [start, end] of times; write [5, 15]"),
    (
        "rotation.program=[[2, 0], [2, 54], [2, 9]]",
        "must be later than the two knots before it, which are a jump",
    ),
    (
        "run.time_step=1e-4",
        'at most 1.906e-5, a tenth of the shortest collision time; or set run.time_step = "auto"',
    ),
    ("drum.baffles=3", "drum.baffles is 3, but must be a table of keys: count, shape"),
    ("load.diameter=0.47", "one bundle of diameter 0.47 fills 0.9791 of a drum of diameter 0.475"),
    ("load.diameter=0.5", "load.diameter"),
    ("run.window=[5, 40]", "run.duration"),
    ("run.window=[7, 7]", "start < end"),
    ("run.window=[-1, 7]", "run.window"),
    ("run.window=[5", "run.window"),
    ("run.window=[5]", "run.window is [5], but must be a pair"),
    ("run.window=[]", "run.window is [], but must be a pair"),
    ("run.sample_every=20", "run.sample_every is 20.0, but must be at most 5,"),
    ("run.duration=0.001", "run.sample_every is 0.002, but must be at most 0.0001667"),
    ("contact.drum.stiffness_ratio=0", "contact.drum.stiffness_ratio is 0, but must be a positive"),
    ("run.time_step=2e-5", "a tenth of the shortest collision time"),
    ("run.time_step=1e-300", "9007199254740992 time steps of 1e-300 s"),
    ("run.duration=1e300", "run.duration is 1e+300, but must be at most"),
    ("run.seed=-1", "run.seed"),
    ("run.skin=-1", "run.skin"),
    ("run.overlap_limit=1", "run.overlap_limit"),
    ("rotation.program=[]", "at least 1 knot"),
    ("rotation.program=[[1, 5], [0, 5]]", "rotation.program"),
    ("rotation.program=[[0, nan]]", "rotation.program"),
    ("rotation.rpm=nan", "rotation.rpm"),
    ("gravity=[0]", "gravity"),
    ("drum.rim=false", "drum.rim is false, but must be true where no initial state is given"),
    ("drum.walls=[[[0, 0], [0, 0]]]", "drum.walls"),
    ("drum.baffles.shape=round", "drum.baffles.shape"),
    ("load=3", "load is 3"),
]

BAFFLES = [
    (["height=0.3"], "drum.baffles"),
    (["height=0.2375"], "drum.baffles"),
    (["base=0.6"], "drum.baffles"),
    (["count=80"], "drum.baffles"),
    (["shape=polygon"], "drum.baffles.points"),
    (["shape=polygon", "points=[[0, -0.03], [0.05, 0.03], [0.05, -0.03], [0, 0.03]]"], "drum.baffles.points"),
    (["shape=polygon", "points=[[0, -0.03], [0, -0.03], [0.05, 0], [0, 0.03]]"], "drum.baffles.points"),
    (["shape=trapezoid", "tip=-0.01"], "drum.baffles.tip"),
]


def refused(drum, tmp_path, *words: str, names: str) -> None:
    out = tmp_path / "out"
    status, printed, complaint = drum("run", *words, "--out", out)
    assert status == 2, complaint
    assert printed == ""
    assert complaint.count("\n") == 1
    assert names in complaint
    assert "Traceback" not in complaint
    assert not out.exists()


@pytest.mark.parametrize(("setting", "names"), SETTINGS)
def test_bad_setting(drum, tmp_path, setting, names):
    refused(drum, tmp_path, "--set", setting, names=names)


@pytest.mark.parametrize(("settings", "names"), BAFFLES)
def test_bad_baffle(drum, tmp_path, settings, names):
    words = [word for setting in ["count=3", *settings] for word in ("--set", f"drum.baffles.{setting}")]
    refused(drum, tmp_path, *words, names=names)


@pytest.mark.parametrize(
    ("words", "names"),
    [
        (["--set", "load.fill=0.2", "--set", "load.count=5"], "load.fill and load.count"),
        (["--set", "rotation.rpm=1", "--set", "rotation.program=[[0, 1]]"], "rotation.rpm"),
        (["--set", "novalue"], "KEY=VALUE"),
        (["--seed", "-1"], "run.seed"),
        (["--threads", "0"], "threads is 0"),
        (["--threads", "-2"], "threads is -2"),
        (["--threads", "many"], "--threads"),
        (["nowhere.toml"], "'nowhere.toml' cannot be read as a file of configuration keys: No such file"),
        (["."], "'.' cannot be read as a file of configuration keys: Is a directory; drumrs config"),
        (
            ["--set", "load.fill", "0.2"],
            "--set is 'load.fill', but must be KEY=VALUE; such as --set load.fill=0.2",
        ),
        (["a.toml", "b.toml"], "'b.toml' is more than the command takes"),
        (["--softer", "many"], "many is not a number"),
        (["--until", "200%"], "--until is 2.0, but must be between 0 and 1"),
        (["--set", "drum.rim=false", "--set", "drum.baffles.count=3"], "drum.baffles.count"),
    ],
)
def test_bad_words(drum, tmp_path, words, names):
    refused(drum, tmp_path, *words, names=names)


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("load = [", "not valid TOML"),
        ("[load]\nfil = 0.3", "did you mean load.fill?"),
        ("[load]\nfill = 0.3\ncount = 3", "both given"),
        ("load = 3", "load is 3"),
        ("[load]\nfill = .5", "write fill = 0.5"),
        ("[load]\nfill = 0,5", "write fill = 0.5"),
        ("[load]\nfill = 25%  # a quarter", "write fill = 0.25"),
        ("[drum]\nrim = True", "write rim = true"),
        ("[drum.baffles]\nshape = triangle", 'write shape = "triangle"'),
        ("load:\n  fill: 0.2", "line 1 is 'load:', but must be KEY = VALUE or [TABLE]"),
        ('{"load": {"fill": 0.2}}', "a file of JSON has a name that ends with .json"),
        ('[load]\ndiameter = "23 mm"', "without 'mm'"),
    ],
)
def test_bad_file(drum, tmp_path, text, names):
    case = tmp_path / "case.toml"
    case.write_text(text)
    refused(drum, tmp_path, case, names=names)


@pytest.mark.parametrize(
    "text", ["[load]\nfill = 0.1\n", "[load]\r\nfill = 0.1\r\n", '{"load": {"fill": 0.1}}']
)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_files_as_editors_write_them(tmp_path, text, encoding):
    path = tmp_path / ("case.json" if text.startswith("{") else "case.toml")
    path.write_bytes(text.encode(encoding))
    assert drumrs.Config.read(path).load.fill == 0.1


@pytest.mark.parametrize(
    ("action", "names"),
    [
        (
            lambda: drumrs.baseline().replace("load.fill=0.3"),
            "changes is 'load.fill=0.3', but must be a dict",
        ),
        (lambda: drumrs.baseline().softer("100"), "softer is '100'"),
        (
            lambda: drumrs.Simulation("case.toml"),
            r"but must be a Config; drumrs.Config.read\(path\) reads a file",
        ),
        (lambda: drumrs.run({"load.fill": 0.1}), "but must be a Config"),
        (lambda: drumrs.Simulation(drumrs.baseline(), state=[[0, 0]]), "but must be a drumrs.State"),
        (lambda: drumrs.Simulation(drumrs.baseline(0.1)).run("1 s"), "duration is '1 s'"),
        (
            lambda: drumrs.Simulation(drumrs.baseline(0.1)).summary("all"),
            r"window is 'all', but must be a pair",
        ),
        (
            lambda: drumrs.Simulation(drumrs.baseline(0.1)).result(),
            r"within the 0 s simulated so far; run\(\) without arguments simulates all of run.duration",
        ),
    ],
)
def test_arguments_of_another_type_are_refused_with_the_way_out(action, names):
    with pytest.raises(ConfigError, match=names):
        action()


def test_folder_that_cannot_be_written(drum, tmp_path):
    (tmp_path / "file").write_text("in the way")
    for out in (tmp_path / "file", tmp_path / "file" / "below", "/proc/drumrs"):
        status, printed, complaint = drum("run", "--out", out)
        assert (status, printed) == (2, "")
        assert "--out is" in complaint
        assert complaint.count("\n") == 1


@pytest.mark.parametrize(
    ("words", "names"),
    [
        (["run", "--set", "run.duration=0.02", "--out", "{}"], "--out is '{}', but must be"),
        (["run", "{}.toml", "--out", "out"], "'{}.toml' cannot be read"),
        (["sweep", "{}.toml", "--out", "out"], "'{}.toml' cannot be read"),
        (["sweep", "sweep.toml", "--out", "{}"], "--out is '{}', but must be"),
        (["run", "--resume", "{}"], "cannot use the checkpoint '{}"),
        (["status", "{}"], "'{}'"),
        (["view", "{}"], "'{}' cannot be the name of a file: File name too long"),
        (["export", "{}", "--to", "csv"], "'{}"),
    ],
)
def test_a_name_that_is_too_long_is_named_in_a_sentence(drum, tmp_path, monkeypatch, words, names):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "sweep.toml").write_text("[axes]\nload.fill = [0.05]\n")
    name = 260 * "a"
    status, printed, complaint = drum(*(word.format(name) for word in words))
    assert (status, printed, complaint.count("\n")) == (2, "", 1)
    assert names.format(name) in complaint
    assert "Errno" not in complaint
    assert [path.name for path in tmp_path.iterdir()] == ["sweep.toml"]


@pytest.mark.parametrize("words", [["--out", ""], ["--out="], ["--resume", ""]])
def test_an_empty_path_is_not_the_current_folder(drum, tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    status, printed, complaint = drum("run", *words)
    assert (status, printed) == (2, "")
    assert complaint.count("\n") == 1
    assert f"{words[0].rstrip('=')}: the path is empty; the current folder is '.'" in complaint
    assert not list(tmp_path.iterdir())


def test_resume_takes_no_case(drum, tmp_path):
    status, _, complaint = drum("run", "--resume", tmp_path, "--seed", "3")
    assert status == 2
    assert "--resume" in complaint


@pytest.fixture
def checkpoint(short, tmp_path):
    simulation = drumrs.Simulation(short)
    simulation.run(steps=101)
    simulation.save(tmp_path / "checkpoint.bin")
    return tmp_path / "checkpoint.bin"


def resealed(data: bytes) -> bytes:
    return data + hashlib.sha256(data).digest()


DAMAGE = {
    "empty": lambda data: data[:0],
    "another file": lambda data: b"PK" + data,
    "another version": lambda data: resealed(data[:-32].replace(b"checkpoint 1\n", b"checkpoint 2\n", 1)),
    "a core of another version": lambda data: resealed(_core_of_version_99(data[:-32])),
    "half": lambda data: data[: len(data) // 2],
    "last byte missing": lambda data: data[:-1],
    **{
        f"byte {where} flipped": lambda data, w=where: _flipped(data, int(w * (len(data) - 1)))
        for where in (0.0, 0.01, 0.3, 0.6, 0.99, 1.0)
    },
}


def _core_of_version_99(data: bytes) -> bytes:
    magic = b"DRUMRS\r\n"
    version = data.index(magic) + len(magic)
    return data[:version] + bytes([99]) + data[version + 1 :]


def _flipped(data: bytes, index: int) -> bytes:
    return data[:index] + bytes([data[index] ^ 1]) + data[index + 1 :]


@pytest.mark.parametrize("damage", DAMAGE)
def test_bad_checkpoint(drum, checkpoint, damage):
    checkpoint.write_bytes(DAMAGE[damage](checkpoint.read_bytes()))
    with pytest.raises(CheckpointError, match="checkpoint"):
        drumrs.Simulation.load(checkpoint)
    status, printed, complaint = drum("run", "--resume", checkpoint.parent)
    assert (status, printed) == (2, "")
    assert complaint.count("\n") == 1
    assert sorted(path.name for path in checkpoint.parent.iterdir()) == ["checkpoint.bin"]


@pytest.mark.parametrize(
    "state",
    [
        drumrs.State(positions=[[0.0, 0.0, 0.0]]),
        drumrs.State(positions=[]),
        drumrs.State(positions="here"),
        drumrs.State(positions=[[0.0, 0.0]], angles=[0.0, 1.0]),
        drumrs.State(positions=[[0.0, float("nan")]]),
        drumrs.State(positions=[[0.0, 0.0]], radii=[-1.0]),
        drumrs.State(positions=[[5.0, 0.0]]),
    ],
)
def test_bad_state(short, state):
    with pytest.raises(ConfigError):
        drumrs.Simulation(short, state=state)


@pytest.mark.parametrize("threads", [0, -1, 1.5, True])
def test_bad_threads(short, threads):
    with pytest.raises(ConfigError, match="threads"):
        drumrs.Simulation(short, threads=threads)


@pytest.mark.parametrize(
    "arguments",
    [
        {"steps": -1},
        {"steps": 2**60},
        {"duration": float("nan")},
        {"duration": -1.0},
        {"duration": 1e300},
        {"duration": 1, "steps": 1},
    ],
)
def test_bad_length_of_run(short, arguments):
    with pytest.raises(ConfigError):
        drumrs.Simulation(short).run(**arguments)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--seed", "1.5"], "--seed: 1.5 is not a whole number"),
        (["--seed", "-0.5"], "--seed: -0.5 is not a whole number"),
        (["--threads", "2.7"], "--threads: 2.7 is not a whole number"),
        (["--fill", "0.2"], "--fill is not an option; write --set load.fill=VALUE"),
        (["--set", "run.window=[5,", "15]"], "'15]' stands alone; a value with spaces needs quotes"),
    ],
)
def test_words_for_what_people_type(drum, words, told):
    status, printed, complaint = drum("run", *words)
    assert (status, printed) == (2, "")
    assert told in complaint
    assert complaint.count("\n") == 1


def test_a_key_is_advised_only_where_keys_are_taken(drum):
    _, _, complaint = drum("reproduce", "--scale", "quick")
    assert "--scale" in complaint
    assert "--set" not in complaint


def test_a_whole_number_may_be_written_as_one(drum):
    brief = ["--set", "run.duration=0.01", "--set", "run.sample_every=0.001", "--set", "load.count=1e1"]
    status, printed, _ = drum("run", "--seed", "1e3", "--json", *brief)
    assert status == 0
    assert '"bundle_count": 10' in printed


def test_a_run_of_a_file_and_rows_that_are_no_table(tmp_path):
    (tmp_path / "case.toml").write_text("run.duration = 0.01\nrun.sample_every = 0.001\nload.count = 5\n")
    assert drumrs.run(tmp_path / "case.toml", progress=False).summary.bundle_count == 5
    rows = [{"load.fill": 0.1}, {"load.fill": 0.2}]
    assert len(drumrs.Sweep.from_rows(drumrs.baseline(), rows).cases) == 2
    with pytest.raises(ConfigError, match="the table of rows is of type int, but must be a table"):
        drumrs.Sweep.from_rows(drumrs.baseline(), 5)
