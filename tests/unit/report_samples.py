"""Results for the tests of renderers and commands: an audit of two traces, a check of three properties."""

from __future__ import annotations

from mmsverify.results import Audit, AuditedInput, Finding, ModelCheck, PathStep, Verdict

HOSTILE = "<script>alert(1)</script>\x1b[31m\n\u202e&\"'\udc80\x00"

SELECT = Finding(
    path="a.mcap",
    index=17,
    time=1764000000123456789,
    topic="/cell7/mms/a1/server",
    vmd="cell7",
    severity="error",
    rule="select.controlled-elsewhere",
    clauses=("R-7.4.4.2-d",),
    message="Select answered result(+), but R_ARM is controlled by 'Paint'",
    expected=("result(-)",),
    observed="result(+)",
    before={
        "control": {"R_ARM": "CONTROLLED", "Paint": {"oneOf": ["NORMAL", "CONTROLLING"]}},
        "selected": [],
    },
    related=(3, 9, 16),
)
START = Finding(
    path="a.mcap",
    index=4,
    time=1764000000000000005,
    topic="/cell7/mms/a1/client",
    vmd="cell7",
    severity="warning",
    rule="start.direct",
    clauses=("R-7.4.2-a",),
    message="R_ARM was started directly",
    readings=("RP-06",),
    count=5,
)
UNREADABLE = Finding(
    path="b.mcap",
    index=None,
    time=None,
    topic=None,
    vmd=None,
    severity="error",
    rule="input.unreadable",
    clauses=(),
    message="not an MCAP file",
)
READ = AuditedInput(path="a.mcap", messages=1204, events=1200, skipped=4, truncated=False, seconds=0.31234567)

AUDIT = Audit(inputs=[READ], findings=[UNREADABLE, SELECT, START])
CLEAN = Audit(inputs=[READ], findings=[])

STEPS = (
    PathStep(
        "create", {"pi": "A", "domains": ["D"]}, ("R-7.3.2-a",), {"control": {"A": "NORMAL"}, "selected": []}
    ),
    PathStep("select", {"pi": "A"}, ("R-7.4.4.2-f1",), {"control": {"A": "CONTROLLING"}, "selected": ["A"]}),
    PathStep("delete", {"pi": "A"}, (), {"control": {"A": "NORMAL"}, "selected": ["A"]}),
)
BROKEN = Verdict(
    name="selected-is-controlling",
    kind="always",
    clauses=("R-6.1.3.2.6-2",),
    result="violated",
    method="bmc",
    scope="PI=2, Client=1",
    seconds=0.021234,
    depth=3,
    counterexample=STEPS,
    statement="the selected program invocation is CONTROLLING",
)
REACHED = Verdict(
    name="something-runs",
    kind="sometimes",
    clauses=("R-5.3.1.3.2.4-1",),
    result="proved",
    method="exhaustive",
    scope="PI=2, Client=1",
    seconds=0.5,
    witness=STEPS[:1],
)
OPEN = Verdict(
    name="stop-is-final",
    kind="step",
    clauses=("R-5.3",),
    result="unknown",
    method="bmc",
    scope="PI=2, Client=1",
    seconds=10.0,
    depth=8,
    reason="time limit of 10 s reached",
)
CHECK = ModelCheck(
    model="mms-robot", variant="as-written", verdicts=[BROKEN, REACHED, OPEN], notes=["two rows overlap"]
)
