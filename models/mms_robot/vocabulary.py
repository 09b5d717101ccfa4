"""The words of the robot standard: sorts, state variables and the parameters of its services (clauses 3, 5.3, 6).

A reference from one program invocation to another is a relation, so that "the list says" and "the reference
says" are two facts whose agreement is a property and not a given. NONE and UNCONTROLLED are "no element".
"""

from mmsverify.model import (
    BOOL,
    Derived,
    Each,
    Enumeration,
    Model,
    Relation,
    Variable,
    for_all,
    for_some,
    if_,
    integer,
    optional,
    parameter,
    repaired,
)  # fmt: skip


class Control(Enumeration):
    """The control attribute of a program invocation (6.3.2.2)."""

    NORMAL = "NORMAL"
    CONTROLLING = "CONTROLLING"
    CONTROLLED = "CONTROLLED"


class State(Enumeration):
    """The state of a program invocation (base standard); the last four are entered by an indication, left by its response."""

    NON_EXISTENT = "NON-EXISTENT"
    UNRUNNABLE = "UNRUNNABLE"
    IDLE = "IDLE"
    RUNNING = "RUNNING"
    STOPPED = "STOPPED"
    STARTING = "STARTING"
    STOPPING = "STOPPING"
    RESUMING = "RESUMING"
    RESETTING = "RESETTING"


class Mode(Enumeration):
    """The running mode of a controlling program invocation (6.3.2.5)."""

    FREE_RUN = "FREE-RUN"
    CYCLE_LIMITED = "CYCLE-LIMITED"
    STEP_LIMITED = "STEP-LIMITED"


class RobotState(Enumeration):
    """The robot operation states of figure 8 (5.3.1.3.2)."""

    IDLE = "ROBOT-IDLE"
    LOADED = "ROBOT-LOADED"
    READY = "ROBOT-READY"
    EXECUTING = "ROBOT-EXECUTING"
    MOTION_PAUSED = "ROBOT-MOTION-PAUSED"
    INTERVENTION = "MANUAL-INTERVENTION-REQUIRED"


class Logical(Enumeration):
    """The logical status of the VMD (base standard; Table 1)."""

    STATE_CHANGES_ALLOWED = "STATE-CHANGES-ALLOWED"
    NO_STATE_CHANGES_ALLOWED = "NO-STATE-CHANGES-ALLOWED"
    LIMITED_SERVICES_PERMITTED = "LIMITED-SERVICES-PERMITTED"
    SUPPORT_SERVICES_ALLOWED = "SUPPORT-SERVICES-ALLOWED"


class Physical(Enumeration):
    """The physical status of the VMD (base standard)."""

    OPERATIONAL = "OPERATIONAL"
    PARTIALLY_OPERATIONAL = "PARTIALLY-OPERATIONAL"
    INOPERABLE = "INOPERABLE"
    NEEDS_COMMISSIONING = "NEEDS-COMMISSIONING"


class DomainState(Enumeration):
    """The state of a domain (base standard); READY is IN-USE while a program invocation is bound to it."""

    NON_EXISTENT = "NON-EXISTENT"
    LOADING = "LOADING"
    COMPLETE = "COMPLETE"
    INCOMPLETE = "INCOMPLETE"
    READY = "READY"


class UploadState(Enumeration):
    """The state of an upload state machine (base standard), which an ulsmID names on its association."""

    NON_EXISTENT = "NON-EXISTENT"
    UPLOADING = "UPLOADING"
    UPLOADED = "UPLOADED"


class Calibration(Enumeration):
    """The calibration state of a physical resource (6.2.2.4, 6.3.6)."""

    CALIBRATED = "CALIBRATED"
    NOT_CALIBRATED = "NOT-CALIBRATED"
    CALIBRATING = "CALIBRATING"


class Vocabulary(Model):
    """Sorts, variables and parameters; no rows."""

    PI = Each("ProgramInvocation")
    Client = Each("Association")
    Request = Each("Request")
    Domain = Each("Domain")
    Upload = Each("Upload")
    Device = Each("Device")
    Joint = Each("Joint")

    # What a profile fixes.
    predefined = Relation(PI, rigid=True, doc="exists at power-on")
    predefined_control = Variable(Control, PI, rigid=True, doc="its control attribute then")
    predefined_deletable = Relation(PI, rigid=True, doc="can be deleted by MMS")
    predefined_reusable = Relation(PI, rigid=True)
    predefined_arm = Relation(PI, rigid=True, doc="is bound to a domain of a robot arm")
    predefined_controls = Relation(PI, PI, rigid=True, doc="the list of a names c at power-on")
    selected_at_power_on = Relation(PI, rigid=True)
    calibrates = Relation(PI, rigid=True, doc="R_CAL, the calibration program (6.3.6, 8.3.2)")
    standard_arm = Relation(PI, rigid=True, doc="R_ARM, the arm program by its standardized name (8.3.1)")
    step_limited = Relation(rigid=True, doc="STEP-LIMITED is supported (PICS part 6)")
    single_task = Relation(
        rigid=True, doc="holds one task program: load and assign are one operation (5.3.1.3.3.4)"
    )
    single_association = Relation(rigid=True, doc="base class: one association, which holds R_CTRL")
    calibrates_device = Relation(
        PI, Device, rigid=True, doc="the calibration program is for this physical resource"
    )
    jointed = Relation(Device, rigid=True, doc="a robot arm, calibrated by its joints (6.2.2.4)")
    needs_calibration = Relation(Device, rigid=True, doc="has a calibration attribute (6.2.2.4, 6.2.3.4)")

    # Program invocations (6.3.2).
    state = Variable(State, PI)
    control = Variable(Control, PI, cites=["R-6.3.2.2-1"])
    deletable = Relation(PI)
    reusable = Relation(PI)
    arm = Relation(PI, doc="bound to a domain that represents a robot arm")
    controls = Relation(PI, PI, doc="controls[a, c]: the list of a names c (6.3.2.3)",
                        cites=["R-6.3.2-2", "R-6.3.1-1", "R-6.3.1-2", "R-6.3.2.2-4"])  # fmt: skip
    controller = Relation(
        PI, PI, doc="controller[c, a]: the reference of c names a (6.3.2.8)", cites=["R-6.3.2-4"]
    )
    mode = Variable(Mode, PI, cites=["R-6.3.2-2", "R-5.3.2-3"])
    cycles = Variable(integer(0), PI, doc="remaining cycle count (6.3.2.6)", cites=["R-6.3.2-3", "R-5.3.2-1"])
    steps = Variable(integer(0), PI, doc="remaining step count (6.3.2.7)", cites=["R-6.3.2-3", "R-5.3.2-1"])
    error_code = Variable(
        integer(), PI, doc="the last recorded error of its execution; zero is none (6.3.2.1)"
    )
    located = Relation(PI, doc="its program location is not the empty string (6.3.2.4)")
    starts_elsewhere = Relation(
        PI, doc="execution begins at a start location, not at the first step (7.3.3.3.1.1)"
    )
    untried = Relation(
        PI, doc="created by MMS, and not asked to start since: nothing of it has been executed"
    )

    # Physical resources, each the domain that represents it, and what the VMD says of all of them (6.1.3, 6.2).
    power = Relation(
        Device, doc="the resource is powered (6.2.2.3, 6.2.3.3)", cites=["R-6.2.2.1-1", "R-6.2.3.1-1"]
    )
    calibration = Variable(Calibration, Device, doc="means something where it needs calibration",
                           cites=["R-6.2.2.1-1", "R-6.2.3.1-1"])  # fmt: skip
    joint_calibration = Variable(Calibration, (Device, Joint), doc="of each joint of an arm (6.2.2.8.2.2)",
                                 cites=["R-6.2.2.1-2"])  # fmt: skip
    device_local = Relation(Device, doc="some local agent holds control of the resource (6.2.2.2, 6.2.3.2)",
                            cites=["R-6.2.2.1-1", "R-6.2.3.1-1"])  # fmt: skip
    any_power = Relation(doc="any physical resource power on (6.1.3.2.3)")
    all_calibrated = Relation(doc="all physical resources calibrated (6.1.3.2.4)")
    interlocks_violated = Relation(
        doc="the safety interlocks were violated since their last reset (6.1.3.2.1)"
    )

    # Domains (6.2.1, 8.2): what a profile predefines, their life, who is bound to them, who loads or reads them.
    predefined_domain = Relation(Domain, rigid=True, doc="exists at power-on")
    predefined_uses = Relation(PI, Domain, rigid=True)
    predefined_sharable = Relation(Domain, rigid=True)
    standard_domain = Relation(
        Domain, rigid=True, doc="R_ARM, R_CAL or R_SAFE by its standardized name (8.2)"
    )
    arm_domain = Relation(Domain, rigid=True, doc="R_ARM (8.2.1)")
    calibration_domain = Relation(Domain, rigid=True, doc="R_CAL (8.2.2)")
    domain_state = Variable(DomainState, Domain)
    domain_deletable = Relation(Domain)
    sharable = Relation(Domain, doc="several program invocations may be bound to it")
    uses = Relation(PI, Domain, doc="uses[p, d]: the domain list of p names d")
    loads = Relation(Client, Domain, doc="the association on which the domain is being downloaded")
    upload_state = Variable(UploadState, Upload)
    uploads = Relation(Client, Upload, doc="the association of an upload state machine")
    source = Relation(Upload, Domain, doc="the domain that is uploaded")

    # The VMD (6.1.3) and the arm (6.2.2.5).
    selected = Relation(
        PI, doc="at most one: the selected program invocation (6.1.3.2.6)", cites=["R-6.1.3.1-6"]
    )
    motion = Relation(doc="motion enabled (3.2.2, 6.2.2.5)", cites=["R-6.2.2.5-1", "R-3.2.2-1"])
    local_control = Relation(doc="some local agent holds control (3.2.1, 6.1.3.2.5)",
                             cites=["R-6.1.3.1-5", "R-5.3.1.4-1"])  # fmt: skip
    logical = Variable(Logical)
    physical = Variable(Physical)
    robot_state = Variable(RobotState, doc="as the text has it: a stored attribute that 6.3.5 and 7.4 change",
                           cites=["R-6.1.3.1-2", "R-6.1.3.2.2-1"])  # fmt: skip

    # Associations, the semaphore R_CTRL (8.6.1), outstanding requests.
    associated = Relation(Client)
    holder = Relation(Client, doc="owns the one token of R_CTRL", cites=["R-8.6.1-1"])
    limited = Relation(Client, doc="took R_CTRL with controlTimeOut: its ownership may end by itself")
    keeps = Relation(Client, doc="took R_CTRL with relinquishIfConnectionLost FALSE")
    hung = Relation(doc="the token of R_CTRL belongs to nobody, and is not free")
    entered = Relation(
        Request, PI, doc="this request's indication brought the program invocation into its transient state"
    )
    selecting = Relation(Request, PI, doc="a Select indication of it is being handled: figure 10, 101 or 104")

    p, a, b, c = PI.elements("p a b c")
    u, v = Client.elements("u v")
    q = Request.element("q")
    d = Domain.element("d")
    x = Upload.element("x")
    r = Device.element("r")
    j = Joint.element("j")

    # Parameters of the services.
    request = Request.element("request")
    user = Client.element("user")
    times_out = parameter("times_out", BOOL)
    stays = parameter("stays", BOOL)
    preempts = parameter("preempts", BOOL)
    panel = parameter("panel", BOOL)
    pi = PI.element("pi")
    controlling = PI.maybe("controlling")
    controlled = PI.some("controlled")
    named_twice = parameter("named_twice", BOOL)
    kind = parameter("kind", Control)
    reuse = parameter("reuse", BOOL)
    binds_arm = parameter("binds_arm", BOOL)
    assigned = PI.some("assigned")
    location_given = parameter("location_given", BOOL)
    limit = optional("limit", Mode)
    count = parameter("count", integer())
    destructive = parameter("destructive", BOOL)
    type_given = parameter("type_given", BOOL)
    prevented = parameter("prevented", BOOL)
    taken = parameter("taken", BOOL)
    status = parameter("status", Logical)
    condition = parameter("condition", Physical)
    cleared = parameter("cleared", BOOL)
    to_idle = PI.some("to_idle")
    to_stopped = PI.some("to_stopped")
    to_unrunnable = PI.some("to_unrunnable")
    domain = Domain.element("domain")
    domains = Domain.some("domains")
    shares = parameter("shares", BOOL)
    more = parameter("more", BOOL)
    discard = parameter("discard", BOOL)
    upload = Upload.element("upload")
    held = Device.some("held")
    calibrated_joints = Joint.some("calibrated_joints")
    step_fails = parameter("step_fails", BOOL)

    # With a predefined CONTROLLING program invocation there is no ROBOT-IDLE at power-on (6.3.5.2), and never one
    # if it cannot be deleted.
    never_idle = for_some(p)(
        predefined[p] & (predefined_control[p] == Control.CONTROLLING) & ~predefined_deletable[p]
    )

    exists = Derived(state[p] != State.NON_EXISTENT, over=[p])
    some_controlling = Derived(
        for_some(p)((state[p] != State.NON_EXISTENT) & (control[p] == Control.CONTROLLING))
    )
    some_selected = Derived(for_some(p)(selected[p]))
    started = Derived(
        ~state[p].isin([State.NON_EXISTENT, State.UNRUNNABLE, State.IDLE, State.STARTING]), over=[p]
    )
    active = Derived(started[p] & (state[p] != State.STOPPED) | (state[p] == State.STARTING), over=[p])
    runs = Derived(state[p].isin([State.RUNNING, State.STOPPING]), over=[p])
    settled = Derived(
        if_(state[p] == State.STARTING, State.IDLE,
            if_(state[p] == State.STOPPING, State.RUNNING,
                if_(state[p].isin([State.RESUMING, State.RESETTING]), State.STOPPED, state[p]))),
        over=[p], doc="the state that a request found before its indication, which its response(-) gives back",
    )  # fmt: skip
    selected_started = Derived(for_some(p)(selected[p] & started[p]))
    bound = Derived(exists[p] & uses[p, d], over=[p, d])
    in_use = Derived(for_some(p)(bound[p, d]), over=[d])
    in_transfer = Derived(
        domain_state[d].isin([DomainState.LOADING, DomainState.COMPLETE, DomainState.INCOMPLETE]), over=[d]
    )

    # An association ends: what was being downloaded on it is gone, and so are its upload state machines.
    end_transfers = [
        domain_state[d].becomes(DomainState.NON_EXISTENT).over(d).when(loads[user, d]),
        loads[user, d].becomes(False).over(d),
        upload_state[x].becomes(UploadState.NON_EXISTENT).over(x).when(uploads[user, x]),
        source[x, d].becomes(False).over(x, d).when(uploads[user, x]),
        uploads[user, x].becomes(False).over(x),
    ]  # fmt: skip
    # VMD Reset d) as the text has it: every domain that can be deleted goes, whoever uses or transfers it.
    reset_domains = [domain_state[d].becomes(DomainState.NON_EXISTENT).over(d).when(domain_deletable[d])]

    # While the calibration program executes, its resources are CALIBRATING, so that not all are CALIBRATED (6.3.6).
    calibrating = [
        calibration[r].becomes(Calibration.CALIBRATING).over(r).when(calibrates_device[pi, r]),
        joint_calibration[r, j].becomes(Calibration.CALIBRATING).over(r, j).when(calibrates_device[pi, r]),
        all_calibrated().becomes(False).when(for_some(r)(calibrates_device[pi, r])),
    ]  # fmt: skip


class VocabularyRepaired(Vocabulary):
    """The repaired reading: the robot state is a function of the rest, and only MANUAL-INTERVENTION-REQUIRED is stored."""

    intervention = Relation(doc="MANUAL-INTERVENTION-REQUIRED, the one robot state that is stored (RP-12)")

    robot_state = Derived(
        if_(intervention(), RobotState.INTERVENTION,
            if_(~some_controlling(), RobotState.IDLE,
                if_(~some_selected(), RobotState.LOADED,
                    if_(~selected_started(), RobotState.READY,
                        if_(motion(), RobotState.EXECUTING, RobotState.MOTION_PAUSED))))),
        repairs=repaired("RP-12", "R-6.3.4.2-1", "R-6.3.4.3-1", "R-6.3.4.4-1",
                         because="the predicates of 6.3.4 are neither exhaustive nor exclusive; under this mapping they are"),
    )  # fmt: skip

    bound = Derived(uses[p, d], over=[p, d],
                    repairs=repaired("RP-08", "R-7.4.3.2-d", because="what does not exist is bound to no domain, also after VMD Reset"))  # fmt: skip

    # VMD Reset d): the domains of program invocations that remain are in use, and remain; downloads end.
    goes = domain_deletable[d] & for_all(p)(uses[p, d] >> deletable[p])
    clear_domains = [
        domain_state[d].becomes(DomainState.NON_EXISTENT).over(d).when(goes),
        loads[u, d].becomes(False).over(u, d).when(goes),
        source[x, d].becomes(False).over(x, d).when(goes),
        uses[p, d].becomes(False).over(p, d).when(deletable[p]),
    ]  # fmt: skip

    # A calibration program that goes away has not completed (RP-26).
    cut_short = Derived(calibrates_device[p, r] & (calibration[r] == Calibration.CALIBRATING), over=[p, r])
    breaks_off = [
        calibration[r].becomes(Calibration.NOT_CALIBRATED).over(r).when(cut_short[pi, r]),
        joint_calibration[r, j].becomes(Calibration.NOT_CALIBRATED).over(r, j).when(cut_short[pi, r]),
    ]  # fmt: skip
