"""What the base standard claims of domains and of their transfers (9.2.2.2; A5.1).

Stated from the life of a domain and of an upload state machine, not from the services that lead through it.
"""

from mmsverify.model import (
    MINUS,
    PLUS,
    Always,
    Sometimes,
    Step,
    answered,
    any_of,
    for_all,
    if_,
    repaired,
    service_is,
    unchanged,
)

from .vocabulary import DomainState, UploadState, Vocabulary, VocabularyRepaired

NONE, READY = DomainState.NON_EXISTENT, DomainState.READY


class Transfers(Vocabulary):
    """The same in both readings."""

    # The life of a domain: from, to.
    old, new = domain_state[d], domain_state[d].next
    domain_arrows = any_of(
        new == old,
        (old == NONE) & (new == DomainState.LOADING) & service_is("initiateDownloadSequence"),
        (old == NONE) & (new == READY) & service_is("loadDomainContent"),
        (old == DomainState.LOADING)
        & new.isin([DomainState.COMPLETE, DomainState.INCOMPLETE])
        & service_is("downloadSegment"),
        (old == DomainState.COMPLETE) & (new == READY) & service_is("terminateDownloadSequence"),
        in_transfer[d] & (new == NONE) & service_is("terminateDownloadSequence", "release"),
        (old == READY) & (new == NONE) & domain_deletable[d] & service_is("deleteDomain"),
        (new == NONE) & domain_deletable[d] & service_is("vMDReset"),
    )
    domain_is_what_it_was = Step(
        "B-DOMAIN", for_all(d)((domain_state[d] != NONE) >> ((sharable[d].next == sharable[d]) & (domain_deletable[d].next == domain_deletable[d]))),
        says="whether a domain is sharable and deletable is fixed while it exists")  # fmt: skip
    new_domain_as_asked = Step(
        "B-DOWNLOAD", (service_is("initiateDownloadSequence", "loadDomainContent") & answered(PLUS)) >> (
            (domain_state[domain] == NONE) & domain_deletable[domain].next & (sharable[domain].next == shares)), "B-LOAD",
        says="what is loaded is new, can be deleted, and is sharable as asked")  # fmt: skip
    service_names_its_domain = Step(
        "B-DOMAIN", service_is("initiateDownloadSequence", "loadDomainContent", "deleteDomain", "downloadSegment", "terminateDownloadSequence")
        >> for_all(d)((d != domain) >> (domain_state[d].next == domain_state[d])),
        says="a service on a domain changes the state of no other one")  # fmt: skip

    # Downloads (A5.1).
    download_begins = Step(
        "R-A5.1-3", (service_is("initiateDownloadSequence") & answered(PLUS)) >> (
            associated[user] & loads[user, domain].next & (domain_state[domain].next == DomainState.LOADING)), "B-DOWNLOAD",
        says="a download that has begun is loading its domain on that association")  # fmt: skip
    segment_counts = Step(
        "R-A5.1-3", (service_is("downloadSegment") & answered(PLUS) & loads[user, domain] & (domain_state[domain] == DomainState.LOADING)) >> (
            domain_state[domain].next == if_(more, DomainState.LOADING, DomainState.COMPLETE)), "B-DOWNLOAD",
        says="a domain is COMPLETE with its last segment, and not before")  # fmt: skip
    lost_segment_counts = Step(
        "B-DOWNLOAD", (service_is("downloadSegment") & answered(MINUS) & loads[user, domain] & (domain_state[domain] == DomainState.LOADING)) >> (
            domain_state[domain].next == DomainState.INCOMPLETE),
        says="a domain whose segment cannot be had is INCOMPLETE")  # fmt: skip
    transfer_needs_association = Step(
        "B-DOWNLOAD", service_is("downloadSegment", "terminateDownloadSequence") >> (loads[user, domain] | (domain_state[domain].next == domain_state[domain])),
        says="a domain is loaded on the association on which its download began")  # fmt: skip
    download_ends = Step(
        "R-A5.1-3", (service_is("terminateDownloadSequence") & loads[user, domain]) >> (
            ~loads[user, domain].next & (domain_state[domain].next == if_(~discard & (domain_state[domain] == DomainState.COMPLETE), READY, NONE))), "B-DOWNLOAD",
        says="a download that has ended leaves a complete domain READY, and otherwise none")  # fmt: skip
    download_goes_on = Step(
        "B-DOWNLOAD", for_all(u, d)((loads[u, d] & ~loads[u, d].next) >> service_is("terminateDownloadSequence", "release", "vMDReset")),
        says="a download ends by its termination, with its association, or by VMD Reset")  # fmt: skip
    transfers_end_with_association = Step(
        "B-DOWNLOAD", service_is("release") >> (
            for_all(d)((loads[user, d] >> (domain_state[d].next == NONE)) & ~loads[user, d].next)
            & for_all(x)((uploads[user, x] >> (upload_state[x].next == UploadState.NON_EXISTENT)) & ~uploads[user, x].next)
            & for_all(x, d)(uploads[user, x] >> ~source[x, d].next)), "B-UPLOAD",
        says="what was being transferred is lost with its association")  # fmt: skip
    others_transfer_on = Step(
        "B-UPLOAD", service_is("release") >> for_all(u, x, d)((~uploads[user, x] >> ((upload_state[x].next == upload_state[x]) & (source[x, d].next == source[x, d])))
                                                             & ((u != user) >> ((uploads[u, x].next == uploads[u, x]) & (loads[u, d].next == loads[u, d])))),
        "B-DOWNLOAD", says="the end of one association ends no transfer on another")  # fmt: skip

    # Uploads.
    was, becomes = upload_state[x], upload_state[x].next
    upload_arrows = any_of(
        becomes == was,
        (was == UploadState.NON_EXISTENT)
        & (becomes == UploadState.UPLOADING)
        & service_is("initiateUploadSequence"),
        (was == UploadState.UPLOADING) & (becomes == UploadState.UPLOADED) & service_is("uploadSegment"),
        (becomes == UploadState.NON_EXISTENT) & service_is("terminateUploadSequence", "release"),
    )
    upload_life = Step("B-UPLOAD", for_all(x)(upload_arrows), says="uploads come and go along the base standard's diagram")  # fmt: skip
    upload_begins = Step(
        "B-UPLOAD", (service_is("initiateUploadSequence") & answered(PLUS)) >> (
            (upload_state[upload] == UploadState.NON_EXISTENT) & (domain_state[domain] == READY) & (upload_state[upload].next == UploadState.UPLOADING)
            & uploads[user, upload].next & for_all(d)(source[upload, d].next == (d == domain))),
        says="an upload that has begun reads the READY domain that it names, on that association, under an ulsmID that was free")  # fmt: skip
    segment_is_given = Step(
        "B-UPLOAD", (service_is("uploadSegment") & answered(PLUS)) >> (
            uploads[user, upload] & (upload_state[upload] == UploadState.UPLOADING)
            & (upload_state[upload].next == if_(more, UploadState.UPLOADING, UploadState.UPLOADED))),
        says="segments are given while an upload goes on, to its own association, until the last one")  # fmt: skip
    upload_is_over = Step(
        "B-UPLOAD", (service_is("terminateUploadSequence") & answered(PLUS)) >> (
            uploads[user, upload] & (upload_state[upload].next == UploadState.NON_EXISTENT) & ~uploads[user, upload].next & for_all(d)(~source[upload, d].next)),
        says="an upload that has ended is gone")  # fmt: skip
    running_upload_ended = Step("B-UPLOAD", (service_is("terminateUploadSequence") & answered(PLUS)) >> (upload_state[upload] != UploadState.NON_EXISTENT),
                                says="only an upload that goes on is ended")  # fmt: skip
    uploads_are_read_only = Step("B-UPLOAD", service_is("initiateUploadSequence", "uploadSegment", "terminateUploadSequence", "storeDomainContent") >> unchanged(domain_state, uses, loads),
                                 says="reading a domain does not change it")  # fmt: skip

    # Storing, deleting, binding.
    stored_is_ready = Step("B-LOAD", (service_is("storeDomainContent") & answered(PLUS)) >> (domain_state[domain] == READY),
                           says="what is stored is READY or IN-USE")  # fmt: skip
    domain_is_deleted = Sometimes(
        "B-DELETE-DOMAIN",
        service_is("deleteDomain") & (domain_state[domain] == READY) & (domain_state[domain].next == NONE),
    )
    deleted_was_there = Step("B-DELETE-DOMAIN", (service_is("deleteDomain") & answered(PLUS)) >> (domain_state[domain] != NONE),
                             says="what is deleted has been there")  # fmt: skip
    bound_while_it_exists = Step(
        "R-7.3.3.2.3-0", for_all(p, d)((uses[p, d].next != uses[p, d]) >> service_is("createProgramInvocation", "deleteProgramInvocation", "vMDReset")), "B-CREATE", "B-DELETE",
        says="a program invocation is bound to its domains from Create until it goes")  # fmt: skip
    bindings_of_others = Step(
        "B-CREATE", service_is("createProgramInvocation", "deleteProgramInvocation") >> for_all(p, d)((p != pi) >> (uses[p, d].next == uses[p, d])), "B-DELETE",
        says="creating or deleting one program invocation binds or frees no other")  # fmt: skip
    domain_of_one_association = Always("B-UPLOAD", for_all(u, v, x)((uploads[u, x] & uploads[v, x]) >> (u == v)), says="an upload is one association's")  # fmt: skip
    uploading_is_bound = Always("B-UPLOAD", for_all(u, x)(uploads[u, x] >> (upload_state[x] != UploadState.NON_EXISTENT)),
                                says="an association has only uploads that go on")  # fmt: skip


class TransfersRepaired(Transfers, VocabularyRepaired):
    """The repaired reading."""

    domain_life = Step("B-DOMAIN", for_all(d)(domain_arrows), "B-DOWNLOAD", "B-LOAD", "B-DELETE-DOMAIN",
                       says="domains come, are loaded and go along the base standard's diagram",
                       repairs=repaired("RP-08", "R-7.4.3.2-d", because="stated where VMD Reset leaves no transfer of a domain that is gone"))  # fmt: skip
