"""Domains: how they are loaded, read, stored and deleted, and what program invocations need of them (6.2.1, 8.2).

The services are those of the base standard; the robot standard demands them (9.2.2.2), shows them in use
(A5.1) and says what they must not touch (6.3.5). DownloadSegment, TerminateDownloadSequence and the two
RequestDomain services are requests of the robot, which the client answers: what the robot's request needs
stands in an observation, what the answer brings about in a row.
"""

from mmsverify.model import (
    BOOL,
    MINUS,
    PLUS,
    Always,
    Assume,
    Initially,
    Observation,
    Procedure,
    Sometimes,
    Step,
    Transition,
    accept,
    answered,
    do,
    for_all,
    for_some,
    if_,
    needs,
    optional,
    parameter,
    refuse,
    repaired,
    response,
    service_is,
    shown,
    unchanged,
)  # fmt: skip

from .admission import ALL_BUT_RUNNING, admission
from .vocabulary import DomainState, UploadState, Vocabulary, VocabularyRepaired

BY_DOMAIN_SERVICE = (
    "initiateDownloadSequence", "downloadSegment", "terminateDownloadSequence", "initiateUploadSequence", "uploadSegment",
    "terminateUploadSequence", "loadDomainContent", "storeDomainContent", "deleteDomain",
)  # fmt: skip


class Domains(Vocabulary):
    """As written."""

    # Power-on, and what a profile must respect (8.2, 8.3).
    domains_at_power_on = Initially(
        "R-6.1.1-3",
        for_all(d)(
            (predefined_domain[d] >> (domain_state[d] == DomainState.READY))
            & (~predefined_domain[d] >> (domain_state[d] == DomainState.NON_EXISTENT))
        ),
    )
    sharing_at_power_on = Initially(
        "R-8.2.1-3", for_all(d)(sharable[d] == predefined_sharable[d]), "R-8.2.2-2", "R-8.2.3-2"
    )
    fixed_at_power_on = Initially(
        "R-8.2.1-3", for_all(d)(standard_domain[d] >> ~domain_deletable[d]), "R-8.2.2-2", "R-8.2.3-2"
    )
    bound_at_power_on = Initially(
        "R-8.3.1-2", for_all(p, d)(uses[p, d] == predefined_uses[p, d]), "R-8.3.2-2"
    )
    no_download_at_power_on = Initially("R-9.2.2.1-3", for_all(u, d)(~loads[u, d]))
    no_upload_at_power_on = Initially(
        "R-9.2.2.1-3", for_all(u, x)(~uploads[u, x] & (upload_state[x] == UploadState.NON_EXISTENT))
    )
    nothing_read_at_power_on = Initially("R-9.2.2.1-3", for_all(x, d)(~source[x, d]))
    standard_domains_predefined = Assume(
        "R-8.2.1-1", for_all(d)(standard_domain[d] >> predefined_domain[d]), "R-8.2.2-1", "R-8.2.3-1"
    )
    standard_sharing = Assume(
        "R-8.2.1-3", for_all(d)((arm_domain[d] >> (standard_domain[d] & predefined_sharable[d]))
                                & ((standard_domain[d] & ~arm_domain[d]) >> ~predefined_sharable[d])
                                & (calibration_domain[d] >> (standard_domain[d] & ~arm_domain[d]))), "R-8.2.2-2", "R-8.2.3-2")  # fmt: skip
    predefined_bindings = Assume(
        "R-7.3.3.2.3-0",
        for_all(p, d)(predefined_uses[p, d] >> (predefined[p] & predefined_domain[d])),
        "B-CREATE",
    )
    predefined_unshared = Assume(
        "R-7.3.3.2.3-0", for_all(a, b, d)((predefined_uses[a, d] & predefined_uses[b, d] & (a != b)) >> predefined_sharable[d]), "B-CREATE"
    )  # fmt: skip
    arm_bound = Assume(
        "R-8.3.1-2",
        for_all(p, d)((standard_arm[p] & arm_domain[d]) >> predefined_uses[p, d]),
        "R-8.3.1-1",
        "R-8.2.1-4",
    )
    calibration_bound = Assume(
        "R-8.3.2-2",
        for_all(p, d)((calibrates[p] & calibration_domain[d]) >> predefined_uses[p, d]),
        "R-8.3.2-1",
        "R-8.2.2-2",
        "R-6.3.6-2",
    )

    # Downloading (A5.1): the client starts the sequence, the robot asks for each segment and ends it.
    initiate_download = Procedure(
        "R-9.2.2.2.2.1",
        on=response("initiateDownloadSequence", request, user, domain, shares),
        steps=[
            refuse("R-9.2.2.1-3", "B-ASSOCIATION", unless=associated[user], rule="download.no-association", says="{user} has no association"),
            refuse("1", "B-DOWNLOAD", when=domain_state[domain] != DomainState.NON_EXISTENT, rule="download.exists", says="{domain} exists already"),
            do("1", domain_state[domain].becomes(DomainState.LOADING), domain_deletable[domain].becomes(True),
               sharable[domain].becomes(shares), loads[user, domain].becomes(True)),
            accept("1"),
        ],
    )  # fmt: skip
    segment_asked = Observation(
        "R-A5.1-3", "R-9.2.2.2.2.1-1", "B-DOWNLOAD",
        on=shown("downloadSegmentAsked", user, domain),
        shows=[
            needs("R-A5.1-3", "R-9.2.2.2.2.1-1", "B-DOWNLOAD", rule="download.not-begun", that=loads[user, domain],
                  says="no download of {domain} is going on here"),
            needs("R-A5.1-3", "R-9.2.2.2.2.1-1", "B-DOWNLOAD", rule="download.not-loading", that=domain_state[domain] == DomainState.LOADING,
                  says="{domain} is not being loaded, or its last segment has come"),
        ],
    )  # fmt: skip
    segment_given = Transition(
        "R-A5.1-3", "R-9.2.2.2.2.1-1", "B-DOWNLOAD",
        on=response("downloadSegment", user, domain, more),
        then=[domain_state[domain].becomes(DomainState.COMPLETE).when(~more & loads[user, domain] & (domain_state[domain] == DomainState.LOADING))],
        answer=PLUS,
    )  # fmt: skip
    segment_failed = Transition(
        "R-9.2.2.2.2.1-1", "B-DOWNLOAD",
        on=response("downloadSegment", user, domain),
        then=[domain_state[domain].becomes(DomainState.INCOMPLETE).when(loads[user, domain] & (domain_state[domain] == DomainState.LOADING))],
        answer=MINUS,
    )  # fmt: skip
    termination_asked = Observation(
        "R-A5.1-3", "R-9.2.2.2.2.1-1", "B-DOWNLOAD",
        on=shown("terminateDownloadSequenceAsked", user, domain, discard),
        shows=[
            needs("R-A5.1-3", "R-9.2.2.2.2.1-1", "B-DOWNLOAD", rule="download.not-begun", that=loads[user, domain],
                  says="no download of {domain} is going on here"),
            needs("R-A5.1-3", "R-9.2.2.2.2.1-1", "B-DOWNLOAD", rule="download.not-complete",
                  that=in_transfer[domain] & (~discard >> (domain_state[domain] == DomainState.COMPLETE)),
                  says="the last segment of {domain} has not come, and nothing says that it is discarded"),
        ],
    )  # fmt: skip
    download_terminated = Transition(
        "R-A5.1-3", "R-9.2.2.2.2.1-1", "B-DOWNLOAD",
        on=response("terminateDownloadSequence", user, domain, discard),
        then=[
            domain_state[domain].becomes(if_(~discard & (domain_state[domain] == DomainState.COMPLETE), DomainState.READY, DomainState.NON_EXISTENT))
            .when(loads[user, domain]),
            loads[user, domain].becomes(False),
        ],
        answer=PLUS,
    )  # fmt: skip

    # Uploading: the client reads the content segment by segment.
    initiate_upload = Procedure(
        "R-9.2.2.2.2.1",
        on=response("initiateUploadSequence", request, user, domain, upload),
        steps=[
            refuse("2", "B-UPLOAD", when=domain_state[domain] != DomainState.READY, rule="upload.domain", says="{domain} is not READY or IN-USE"),
            refuse("2", "B-UPLOAD", when=upload_state[upload] != UploadState.NON_EXISTENT, rule="upload.id-in-use",
                   says="another upload goes on under this ulsmID"),
            do("2", upload_state[upload].becomes(UploadState.UPLOADING), uploads[user, upload].becomes(True),
               source[upload, d].becomes(d == domain).over(d)),
            accept("2"),
        ],
    )  # fmt: skip
    upload_segment = Procedure(
        "R-9.2.2.2.2.1",
        on=response("uploadSegment", request, user, upload, more),
        steps=[
            refuse("2", "B-UPLOAD", unless=(upload_state[upload] == UploadState.UPLOADING) & uploads[user, upload],
                   rule="upload.not-uploading", says="no such upload goes on, or its last segment has been given"),
            do("2", upload_state[upload].becomes(UploadState.UPLOADED).when(~more)),
            accept("2"),
        ],
    )  # fmt: skip
    terminate_upload = Procedure(
        "R-9.2.2.2.2.1",
        on=response("terminateUploadSequence", request, user, upload),
        steps=[
            refuse("2", "B-UPLOAD", unless=(upload_state[upload] != UploadState.NON_EXISTENT) & uploads[user, upload],
                   rule="upload.unknown", says="no such upload goes on"),
            do("2", upload_state[upload].becomes(UploadState.NON_EXISTENT), uploads[user, upload].becomes(False),
               source[upload, d].becomes(False).over(d)),
            accept("2"),
        ],
    )  # fmt: skip

    # Secondary storage, deletion.
    load_domain = Procedure(
        "R-9.2.2.2.2.2",
        on=response("loadDomainContent", request, user, domain, shares),
        steps=[
            refuse("1", "B-LOAD", when=domain_state[domain] != DomainState.NON_EXISTENT, rule="load.exists", says="{domain} exists already"),
            do("1", domain_state[domain].becomes(DomainState.READY), domain_deletable[domain].becomes(True), sharable[domain].becomes(shares)),
            accept("1"),
        ],
    )  # fmt: skip
    store_domain = Procedure(
        "R-9.2.2.2.2.2",
        on=response("storeDomainContent", request, user, domain),
        steps=[
            refuse("1", "B-LOAD", when=domain_state[domain] != DomainState.READY, rule="store.domain", says="{domain} is not READY or IN-USE"),
            accept("1"),
        ],
    )  # fmt: skip
    delete_domain = Procedure(
        "R-9.2.2.2.1",
        on=response("deleteDomain", request, user, domain),
        steps=[
            refuse("3", "B-DELETE-DOMAIN", when=domain_state[domain] == DomainState.NON_EXISTENT, rule="delete-domain.unknown", says="{domain} does not exist"),
            refuse("3", "R-8.2.1-3", "R-8.2.2-2", "R-8.2.3-2", "B-DELETE-DOMAIN", unless=domain_deletable[domain],
                   rule="delete-domain.not-deletable", says="{domain} cannot be deleted by MMS"),
            refuse("3", "B-DELETE-DOMAIN", when=in_use[domain], rule="delete-domain.in-use", says="a program invocation is bound to {domain}"),
            refuse("3", "B-DELETE-DOMAIN", unless=domain_state[domain] == DomainState.READY, rule="delete-domain.state", says="{domain} is not READY"),
            refuse("3", "B-DELETE-DOMAIN", when=for_some(x)(source[x, domain]), rule="delete-domain.upload", says="{domain} is being uploaded"),
            do("3", domain_state[domain].becomes(DomainState.NON_EXISTENT)),
            accept("3"),
        ],
    )  # fmt: skip

    # What messages show of domains.
    shown_domain = parameter("shown_domain", DomainState)
    transient = parameter("transient", BOOL)
    shown_in_use = parameter("shown_in_use", BOOL)
    shown_deletable = parameter("shown_deletable", BOOL)
    shown_sharable = parameter("shown_sharable", BOOL)
    shown_uploading = parameter("shown_uploading", BOOL)
    users = PI.some("users")

    domain_attributes = Observation(
        "R-9.2.2.2.1-3", "B-DOMAIN",
        on=shown("getDomainAttributes", domain, shown_domain, transient, shown_in_use, shown_deletable, shown_sharable, users, shown_uploading),
        shows=[
            needs("R-9.2.2.2.1-3", "B-DOMAIN", rule="domain.in-use-unbound", that=~transient >> (shown_in_use == for_some(p)(users.has(p))),
                  says="IN-USE and the list of program invocations contradict each other"),
            needs("R-9.2.2.2.1-3", "B-DOMAIN", rule="domain.unknown", that=domain_state[domain] != DomainState.NON_EXISTENT,
                  says="{domain} does not exist"),
            needs("R-9.2.2.2.1-3", "B-DOMAIN", rule="domain.deletable", that=standard_domain[domain] | (domain_deletable[domain] == shown_deletable),
                  says="mmsDeletable of {domain} cannot be {shown_deletable}"),
            needs("R-9.2.2.2.1-3", "B-DOMAIN", rule="domain.sharable", that=standard_domain[domain] | (sharable[domain] == shown_sharable),
                  says="sharable of {domain} cannot be {shown_sharable}"),
            needs("R-9.2.2.2.1-3", "B-DOMAIN", rule="domain.state", that=~transient >> (domain_state[domain] == shown_domain),
                  says="{domain} cannot be in that state"),
            needs("R-9.2.2.2.1-3", "B-DOMAIN", rule="domain.users", that=~transient >> for_all(p)(bound[p, domain] == users.has(p)),
                  says="other program invocations are bound to {domain}"),
            needs("R-9.2.2.2.1-3", "B-UPLOAD", rule="domain.uploads", that=~transient >> (for_some(x)(source[x, domain]) == shown_uploading),
                  says="the count of uploads of {domain} cannot be right"),
        ],
    )  # fmt: skip
    unknown_domain = Observation(
        "R-9.2.2.2.1-3", "B-DOMAIN",
        on=shown("noDomainAttributes", domain),
        shows=[needs("R-9.2.2.2.1-3", "B-DOMAIN", rule="domain.refused", level="warning",
                     that=domain_state[domain] == DomainState.NON_EXISTENT, says="{domain} exists")],
    )  # fmt: skip
    shown_arm = optional("shown_arm", BOOL)
    upload_refused = Observation(
        "R-9.2.2.2.2.1-2",
        on=shown("uploadRefused", domain),
        shows=[needs("R-9.2.2.2.2.1-2", "B-UPLOAD", rule="initiateUploadSequence.refused", level="warning",
                     that=(domain_state[domain] != DomainState.READY) | for_some(x)(source[x, domain]), says="nothing stands against it")],
    )  # fmt: skip
    bound_domains = Observation(
        "R-7.3.3.9-1", "B-ATTRIBUTES",
        on=shown("listOfDomainNames", pi, domains, shown_arm),
        shows=[needs("R-7.3.3.9-1", "R-8.3.1-2", "R-8.3.2-2", "B-ATTRIBUTES", rule="attributes.domains",
                     that=exists[pi] >> for_all(d)(uses[pi, d] == domains.has(d)), says="the domains of {pi} cannot be those shown"),
               needs("R-7.3.3.9-1", "R-8.2.1-1", "B-ATTRIBUTES", rule="attributes.domains",
                     that=shown_arm.present >> (arm[pi] == shown_arm), says="the domains of {pi} cannot be those shown")],
    )  # fmt: skip

    # Claims.
    used_domains_exist = Always("R-7.3.3.2.3-0", for_all(p, d)(bound[p, d] >> (domain_state[d] == DomainState.READY)), "R-7.4.3.2-d", "B-CREATE",
                                says="every domain of an existing program invocation exists and is in use")  # fmt: skip
    unshared_has_one_user = Always(
        "R-7.3.3.2.3-0", for_all(a, b, d)((bound[a, d] & bound[b, d] & (a != b)) >> sharable[d]), "R-8.2.2-2", "R-8.2.3-2", "B-CREATE",
        says="a domain that is not sharable has one program invocation at most")  # fmt: skip
    only_existing_use = Always("R-7.3.3.8.1-e", for_all(p, d)(uses[p, d] >> exists[p]), "R-7.4.3.2-d", "B-DELETE",
                               says="what has been deleted is bound to no domain")  # fmt: skip
    standard_domains_remain = Always("R-8.2.1-3", for_all(d)(standard_domain[d] >> ((domain_state[d] == DomainState.READY) & ~domain_deletable[d])),
                                     "R-8.2.2-2", "R-8.2.3-2", says="the standardized domains cannot be deleted")  # fmt: skip
    standard_domains_share = Always("R-8.2.1-3", for_all(d)(standard_domain[d] >> (sharable[d] == arm_domain[d])), "R-8.2.2-2", "R-8.2.3-2",
                                    says="of the standardized domains R_ARM alone is sharable")  # fmt: skip
    arm_keeps_domain = Always("R-8.3.1-2", for_all(p, d)((standard_arm[p] & arm_domain[d]) >> uses[p, d]), "R-8.3.1-1", "R-8.2.1-4",
                              says="R_ARM is bound to domain R_ARM")  # fmt: skip
    calibration_keeps_domain = Always("R-8.3.2-2", for_all(p, d)((calibrates[p] & calibration_domain[d]) >> uses[p, d]), "R-8.3.2-1", "R-8.2.2-2",
                                      says="R_CAL is bound to domain R_CAL")  # fmt: skip
    loading_is_bound = Always("R-A5.1-3", for_all(u, d)(loads[u, d] >> (in_transfer[d] & associated[u])), "B-DOWNLOAD",
                              says="a download belongs to a domain in transfer and to an association")  # fmt: skip
    one_download = Always("R-A5.1-3", for_all(u, v, d)((loads[u, d] & loads[v, d]) >> (u == v)), "B-DOWNLOAD",
                          says="a domain is downloaded on one association")  # fmt: skip
    standard_not_loaded = Always("R-8.2.1-3", for_all(u, d)(loads[u, d] >> ~standard_domain[d]), "R-8.2.2-2", "R-8.2.3-2",
                                 says="no standardized domain is downloaded")  # fmt: skip
    uploads_have_domain = Always(
        "R-9.2.2.2.2.1-2", for_all(x, d)(source[x, d] >> ((domain_state[d] == DomainState.READY) & (upload_state[x] != UploadState.NON_EXISTENT))), "B-UPLOAD",
        says="what is uploaded is a domain that is there")  # fmt: skip
    domains_leave_robot_alone = Step(
        "R-6.3.5.3-4", service_is(*BY_DOMAIN_SERVICE) >> unchanged(state, control, controls, controller, selected, motion, logical, physical, robot_state, uses),
        "R-6.3.5.2-4", says="loading and deleting domains is not seen in the robot state")  # fmt: skip
    remote_cannot_change_domains = Step(
        "R-6.2.1-6", (local_control() & service_is("initiateDownloadSequence", "loadDomainContent", "deleteDomain", "createProgramInvocation",
                                                   "deleteProgramInvocation", "vMDReset") & ~panel) >> unchanged(domain_state, uses),
        "R-3.2.1-1", says="in local control no client loads, binds or deletes domains")  # fmt: skip
    refusal_keeps_domains = Step("R-7.4.3.2-1", (answered(MINUS) & ~service_is("downloadSegment")) >> unchanged(domain_state, uses, sharable, domain_deletable, loads),
                                 says="a result(-) changes no domain, except where a segment could not be had")  # fmt: skip
    deleted_domain_is_gone = Step("R-9.2.2.2.1-3", (service_is("deleteDomain") & answered(PLUS)) >> (domain_state[domain].next == DomainState.NON_EXISTENT),
                                  "B-DELETE-DOMAIN", says="what DeleteDomain deleted is gone")  # fmt: skip
    deletion_spares_users = Step("R-9.2.2.2.1-3", (service_is("deleteDomain") & answered(PLUS)) >> for_all(p)(~(exists[p] & uses[p, domain])),
                                 "B-DELETE-DOMAIN", says="no domain is deleted that a program invocation is bound to")  # fmt: skip
    loaded_domain_is_ready = Step("R-9.2.2.2.2.2-1", (service_is("loadDomainContent") & answered(PLUS)) >> (domain_state[domain].next == DomainState.READY), "B-LOAD",
                                  says="what LoadDomainContent loaded is READY")  # fmt: skip
    created_is_bound = Step("R-7.3.3.2.3-0", (service_is("createProgramInvocation") & answered(PLUS)) >> for_all(d)(uses[pi, d].next == domains.has(d)), "B-CREATE",
                            says="what was created is bound to the domains named")  # fmt: skip
    reset_deletes_free_domains = Step(
        "R-7.4.3.2-d", (service_is("vMDReset") & answered(PLUS)) >> for_all(d)(
            (domain_deletable[d] & for_all(p)(~uses[p, d])) >> (domain_state[d].next == DomainState.NON_EXISTENT)),
        "R-5.3.1.3.3.11-2", "R-5.3.1.3.3.12-2", says="VMD Reset deletes every deletable domain that nothing is bound to")  # fmt: skip

    download_reached = Sometimes(
        "R-A5.1-3", for_some(d)(domain_state[d] == DomainState.COMPLETE), "B-DOWNLOAD"
    )
    program_loaded = Sometimes(
        "R-A5.1-3", for_some(p, d)(exists[p] & ~predefined[p] & uses[p, d]), "B-CREATE"
    )
    upload_ends = Sometimes(
        "R-9.2.2.2.2.1-2", for_some(x)(upload_state[x] == UploadState.UPLOADED), "B-UPLOAD"
    )
    download_is_lost = Sometimes(
        "R-9.2.2.2.2.1-1",
        service_is("release") & for_some(u, d)(loads[u, d] & ~loads[u, d].next),
        "B-DOWNLOAD",
    )


class DomainsRepaired(Domains, VocabularyRepaired):
    """The repaired reading: what would change domains is refused in local control (RP-10) and by the logical status (RP-11)."""

    not_local = refuse(
        "R-6.2.1-6",
        "R-3.2.1-1",
        "RP-10",
        when=local_control(),
        rule="download.local-control",
        says="the robot is in local control",
    )
    admitted = refuse(
        "R-6.1.3.2.5-2",
        "B-STATUS",
        "RP-11",
        unless=logical().isin(ALL_BUT_RUNNING),
        rule="download.logical-status",
        says="the logical status of the VMD does not admit the service",
    )

    initiate_download = Procedure(
        "R-9.2.2.2.2.1",
        on=response("initiateDownloadSequence", request, user, domain, shares),
        steps=[
            not_local,
            admitted,
            refuse("R-9.2.2.1-3", "B-ASSOCIATION", unless=associated[user], rule="download.no-association", says="{user} has no association"),
            refuse("1", "B-DOWNLOAD", when=domain_state[domain] != DomainState.NON_EXISTENT, rule="download.exists", says="{domain} exists already"),
            do("1", domain_state[domain].becomes(DomainState.LOADING), domain_deletable[domain].becomes(True),
               sharable[domain].becomes(shares), loads[user, domain].becomes(True)),
            accept("1"),
        ],
        repairs=repaired("RP-10", "R-6.2.1-6", because="local control regulates what changes the state of a device's domains"),
    )  # fmt: skip
    load_domain = Procedure(
        "R-9.2.2.2.2.2",
        on=response("loadDomainContent", request, user, panel, domain, shares),
        steps=[
            *admission("load", panel, local_control(), logical(), ALL_BUT_RUNNING),
            refuse("1", "B-LOAD", when=domain_state[domain] != DomainState.NON_EXISTENT, rule="load.exists", says="{domain} exists already"),
            do("1", domain_state[domain].becomes(DomainState.READY), domain_deletable[domain].becomes(True), sharable[domain].becomes(shares)),
            accept("1"),
        ],
        repairs=repaired("RP-10", "R-6.2.1-6", because="local control regulates what changes the state of a device's domains"),
    )  # fmt: skip
    delete_domain = Procedure(
        "R-9.2.2.2.1",
        on=response("deleteDomain", request, user, panel, domain),
        steps=[
            *admission("delete-domain", panel, local_control(), logical(), ALL_BUT_RUNNING),
            refuse("3", "B-DELETE-DOMAIN", when=domain_state[domain] == DomainState.NON_EXISTENT, rule="delete-domain.unknown", says="{domain} does not exist"),
            refuse("3", "R-8.2.1-3", "R-8.2.2-2", "R-8.2.3-2", "B-DELETE-DOMAIN", unless=domain_deletable[domain],
                   rule="delete-domain.not-deletable", says="{domain} cannot be deleted by MMS"),
            refuse("3", "B-DELETE-DOMAIN", when=in_use[domain], rule="delete-domain.in-use", says="a program invocation is bound to {domain}"),
            refuse("3", "B-DELETE-DOMAIN", unless=domain_state[domain] == DomainState.READY, rule="delete-domain.state", says="{domain} is not READY"),
            refuse("3", "B-DELETE-DOMAIN", when=for_some(x)(source[x, domain]), rule="delete-domain.upload", says="{domain} is being uploaded"),
            do("3", domain_state[domain].becomes(DomainState.NON_EXISTENT)),
            accept("3"),
        ],
        repairs=repaired("RP-10", "R-6.2.1-6", because="local control regulates what changes the state of a device's domains"),
    )  # fmt: skip
