"""Rules of Modbus/TCP messages beside the rows of the model: framing, pairing, connections."""

from __future__ import annotations

from collections.abc import Mapping

from mmsverify.audit.rule import Rule, rule

MODBUS_RULES: Mapping[str, Rule] = {
    listed.id: listed
    for listed in (
        rule(
            "modbus.undecodable",
            "this is no Modbus/TCP message: {cause}",
            "M-2.2-2", "M-2.2-5", "M-2.2-6", "M-2.2-7",
        ),
        rule(
            "modbus.unasked",
            "the server answers transaction {transaction}, and nothing waits for that on this connection",
            "M-2-S3b", "M-2.2-8", "M-2.2-5",
            expects=("none",), observed="a response",
        ),
        rule(
            "modbus.unanswered",
            "the request is never answered, though a later one on its connection is",
            "M-2-S3b", "M-2.2-8",
            expects=("a response",), observed="none",
        ),
        rule(
            "modbus.unit",
            "the unit identifier is {found}, and that of the request is {wanted}",
            "M-2.2-5", "M-2-S3b",
            expects=("unit={wanted}",), observed="unit={found}",
        ),
        rule(
            "modbus.function",
            "function code {found} answers {wanted}",
            "M-2-S3b", "M-2.2-3", "M-2.2-8",
            expects=("function={wanted}",), observed="function={found}",
        ),
        rule(
            "modbus.response",
            "the response does not belong to the request: {cause}",
            "M-2-S3b", "M-2.2-3", "M-2.2-8",
        ),
        rule(
            "modbus.exception",
            "the exception is malformed: {cause}",
            "M-2-S3b", "M-2.2-3",
        ),
        rule(
            "modbus.refused",
            "exception {code}, but nothing stands against the request",
            "M-2.2-8", "M-2-S3b",
            severity="note", expects=("result(+)",), observed="result(-)",
        ),
        rule(
            "modbus.read-back",
            "{what} {address} is read back as {found}, but {written} was written last{more}: a program may "
            "have written it since, or a client that is not in the recording",
            "M-2.2-8",
            severity="note", expects=("{what} {address}={written}",), observed="{what} {address}={found}",
        ),
        rule(
            "modbus.closed",
            "the {sender} sends on a connection that was {event}",
            "M-2-S4b", "M-2.1-6", "M-2.1-8",
            expects=("none",), observed="a message",
        ),
        rule(
            "modbus.too-many",
            "{count} connections are served, and {most} are the most",
            "M-2.1-11", "M-2.1-12",
            expects=("none",), observed="a connection",
        ),
    )
}  # fmt: skip
