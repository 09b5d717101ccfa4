"""The automaton that builds itself while recordings are audited, and who follows it.

`learned` is the way of a message: known, or worked out by the device and remembered in `tables`. `walk` and
`kernel` follow what is known through the octets of a recording.
"""
