"""Why a finding stands: which earlier messages exclude the event, and what would have been legal instead."""
