"""Rules of the protocol: requests and answers, associations, what Initiate agrees, the conformance class."""

from __future__ import annotations

from mmsverify.audit.rule import rule

PROTOCOL = (
    rule(
        "protocol.undecodable",
        "these octets are not an MMS PDU: {cause}",
        "R-7.3.1-2",
        "R-7.3.4-3",
        "B-SYNTAX",
    ),
    rule(
        "protocol.invoke-id-reused",
        "invokeID {invoke} is used again while the request #{first} with it is outstanding",
        "R-7.3.4-3",
        "B-INVOKE-ID",
    ),
    rule(
        "protocol.too-many-outstanding",
        "{count} requests of the {side} are outstanding where {limit} was negotiated",
        "R-7.3.4-3",
        "B-OUTSTANDING",
    ),
    rule(
        "protocol.unasked",
        "the {side} answers invokeID {invoke}, which nobody asked",
        "R-7.3.4-3",
        "B-RESPONSE",
    ),
    rule(
        "protocol.other-service",
        "the request was {asked}, the answer is for {answered}",
        "R-7.3.4-3",
        "B-RESPONSE",
    ),
    rule(
        "protocol.additional-unconfirmed",
        "an additional service stands in an unconfirmed PDU, where the robot standard has none",
        "R-7.4.1.2-2",
        "R-7.4.1.5-1",
    ),
    rule(
        "protocol.unanswered",
        "{service} is never answered: the association was concluded before",
        "R-7.3.4-3",
        "B-RESPONSE",
    ),
    rule("protocol.no-association", "there is no association: {why}", "R-9.2.1-1", "B-ASSOCIATION"),
    rule("protocol.after-conclude", "the association has been concluded", "R-9.2.2.4-1", "B-ASSOCIATION"),
    rule(
        "protocol.after-conclude-request",
        "the {side} asks for a service while its own Conclude waits for an answer",
        "R-9.2.1-1",
        "B-ASSOCIATION",
    ),
    rule(
        "protocol.conclude-unasked",
        "the {side} answers a Conclude that nobody asked",
        "R-9.2.1-1",
        "B-RESPONSE",
    ),
    rule(
        "protocol.status-of-caller",
        "the side that opened the connection tells a robot's status; what else it does is not judged",
        "R-7.3.2.1-1",
        severity="note",
        shown=True,
    ),
    rule(
        "cancel.unasked",
        "the answer to a Cancel of invokeID {invoke}, which nobody asked",
        "R-9.2.2.2.1-1",
        "B-CANCEL",
    ),
    rule(
        "cancel.unknown",
        "Cancel of invokeID {invoke} succeeds, but no request with it was outstanding",
        "R-9.2.2.2.1-1",
        "B-CANCEL",
    ),
    rule(
        "cancel.known",
        "Cancel of invokeID {invoke} fails as unknown, but the request with it is outstanding",
        "R-9.2.2.2.1-1",
        "B-CANCEL",
    ),
    rule(
        "cancel.performed",
        "the request with invokeID {invoke} is answered positively, and its Cancel, too",
        "R-9.2.2.2.1-1",
        "B-CANCEL",
    ),
    # No message tells why a side ends an association. Directly after a stop it is taken for the consequence
    # where the robot asks for it, and is only worth knowing where anybody may have done it.
    rule(
        "association.concluded-after-stop",
        "the robot concludes the association directly after {cause}",
        "R-9.2.2.4-1",
        "RP-23",
        severity="warning",
    ),
    rule(
        "association.lost-after-stop",
        "the association is lost directly after {cause}; the robot must not be the reason",
        "R-9.2.2.4-1",
        severity="note",
    ),
    rule(
        "negotiation.service",
        "{service} is answered positively, but the {side} did not list it in servicesSupported",
        "R-7.5.2.4-2",
        "R-7.5.1.4-5",
        "B-NEGOTIATION",
    ),
    rule(
        "negotiation.additional",
        "{service} is answered positively, but the {side} did not list it in additionalSupported",
        "R-7.5.2.4-1",
        "R-7.5.2.4-2",
        "R-7.5.3-3",
        "R-7.5.1.4-1",
    ),
    # The text wants a Reject; an error refuses the service as well, and does no harm.
    rule(
        "negotiation.refused",
        "{service} is answered by an error; the {side} did not list it, so that Reject was the answer",
        "R-7.5.1.4-5",
        "R-7.5.2.4-2",
        severity="note",
    ),
    # A protocol error may have come first.
    rule(
        "negotiation.reject-reason",
        "{service} is rejected for {reason}, but the {side} did not list it and has not said so",
        "R-7.5.1.4-5",
        "R-7.5.2.4-2",
        severity="note",
    ),
    rule(
        "negotiation.rejected",
        "{service} is rejected as unrecognized, but the {side} listed it as supported",
        "R-7.5.2.4-2",
        "R-7.5.1.4-4",
        "R-7.5.1.4-3",
    ),
    rule(
        "negotiation.reject-unfounded",
        "{service} is rejected for {reason}, but {why}; the {side} listed it as supported",
        "R-7.5.2.4-2",
        "R-7.5.1.4-4",
    ),
    rule(
        "negotiation.proposed-version",
        "the proposed version number {proposed} leaves none to agree upon: 1 is the first",
        "R-7.5.1.1-2",
        "R-7.5.1.1-1",
    ),
    rule(
        "negotiation.version",
        "the negotiated version number {negotiated} is not between 1 and the proposed {proposed}",
        "R-7.5.2.1-1",
    ),
    rule(
        "negotiation.outstanding",
        "{negotiated} outstanding requests are negotiated where {proposed} were proposed",
        "R-7.3.4-3",
        "B-NEGOTIATION",
    ),
    rule(
        "negotiation.syntax",
        "the answer has the robot's form of the detail, which the request did not propose",
        "R-7.5.2-1",
        "R-7.5.1-1",
        "R-7.3.1-2",
    ),
    rule(
        "negotiation.nesting",
        "nesting level {negotiated} is negotiated where {proposed} was proposed",
        "R-7.3.4-3",
        "B-NEGOTIATION",
    ),
    rule(
        "negotiation.parameters",
        "parameter CBBs are negotiated that were not proposed: {added}",
        "R-7.5.2.2-1",
        "R-7.5.1.2-1",
        "B-NEGOTIATION",
    ),
    rule(
        "negotiation.unagreed",
        "{service} is in the robot standard's syntax, on which Initiate has not agreed",
        "R-7.5.2-1",
        "R-7.3.1-2",
    ),
    rule(
        "negotiation.no-detail",
        "{service} lacks the robot's part, although Initiate has agreed on the robot standard",
        "R-7.3.2.1-3",
        "R-7.3.3.9.3-1",
        "R-7.3.1-2",
    ),
    rule(
        "conformance.services",
        "the robot does not list what the base class requires: {missing}",
        "R-9.2.2.1-1",
        "R-9.2.3.1-1",
        "RP-24",
        severity="warning",
    ),
    # "Should": nothing forbids a robot to do without.
    rule(
        "conformance.third-party",
        "the robot loads from secondary storage, but does not agree to {missing}",
        "R-9.2.2.2.2.2-2",
        severity="note",
    ),
    rule(
        "conformance.parameters",
        "the robot does not agree to {missing}",
        "R-9.2.2.3-1",
        "RP-24",
        severity="warning",
    ),
    rule(
        "conformance.rejected",
        "the robot rejects {service} as unrecognized, which the base class requires",
        "RP-24",
        severity="warning",
    ),
)
