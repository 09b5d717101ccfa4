"""A robot written from the text of the standard alone: it shares no row, rule or engine with the project.

What it says is right by its author's reading of clauses 5 to 9 and of the readings; an audit that blames it
is wrong, or it is. Only the encoder is the project's.
"""
