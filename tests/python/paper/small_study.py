"""A study so small that tests can run it: the snapshots' fills, a moment each."""

from drumrs.paper import Scale

SMALL = Scale(
    seeds=(1,),
    duration=0.4,
    window=(0.2, 0.4),
    fills=(0.25, 0.5, 0.75),
    fills_with_baffles=(0.25, 0.5),
    sizes=(20.0,),
    frictions=(0.5,),
    speeds=(54.0,),
    restitutions=(0.1,),
)
