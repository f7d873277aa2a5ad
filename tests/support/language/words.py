"""Words that cannot be a name alone, by word class, and the field terms among them.

A word of a closed class, a participle, an adverb or an adjective leaves out the noun that it
describes: ``found`` may be ``found_files`` or ``matches``. The lists have the words that occur in
code. `FIELD_TERMS` gives a reason for each word that the field uses as a noun all the same.
"""

from __future__ import annotations

from functools import cache


def word_set(text: str) -> frozenset[str]:
    """Return the words of a text."""
    return frozenset(text.split())


PREPOSITIONS = word_set(
    """aboard about above across after against along amid among around as aside at atop before
    behind below beneath beside besides between beyond but by concerning despite during except
    for from in inside into like near of off on onto out outside over past per since than
    through throughout till to toward towards under underneath until unto up upon versus via
    with within without"""
)
INTERROGATIVES = word_set(
    "how what whatever when whenever where whereas wherever whether which who whom whose why"
)
PRONOUNS = word_set(
    """all another any anybody anyone anything anywhere both each either enough every everybody
    everyone everything few fewer fewest he her hers him his i it its itself least less lots
    many me mine more most much my myself neither no nobody none nothing nowhere one ones other
    others our ours own same several she so some somebody someone something somewhere such that
    the their theirs them themselves these they this those us we whichever you your a an"""
)
"""The pronouns and determiners."""
CONJUNCTIONS = word_set(
    "although and because if lest nor once or otherwise provided so than though unless while yet"
)
ADVERBS = word_set(
    """again ago ahead alike almost alone already also always anew apart aside away back backward
    earlier early else elsewhere even ever everywhere far farther fast forever forward further
    hence here instead inward inwards just late later maybe never not now nowhere often only
    outward outwards rather seldom soon sooner still then there thereby thus today together too
    twice upwards very well"""
)
"""The adverbs that do not end in -ly."""
NOT_ADVERBS = word_set(
    """anomaly apply assembly comply family fly imply july multiply poly ply rally rely reply
    supply tally"""
)
"""Nouns and verbs in -ly; the other words in -ly are adverbs."""

PARTICIPLES = word_set(
    """been begun bent bitten blown born borne bought broken brought built caught chosen dealt done
    drawn driven dug eaten fallen fed felt flown forbidden forgotten fought found frozen given
    gone grown had heard held hidden hung kept known laid lain left lent lit lost made meant met
    mistaken mown overtaken paid proven rebuilt redrawn rewritten ridden risen rung said sat
    seen sent shaken shone shot shown shrunk slept slid slung sold sought sown spent spoken
    sprung spun stolen stood strewn struck stuck sung sunk swept sworn swollen swum swung taken
    taught thought thrown told torn trodden unasked unbound undone unfelt unheard unknown unmade
    unread unseen unsent unspent untold unwound unwritten understood upheld withdrawn withheld
    woken won worn wound woven written"""
)
"""The irregular past participles; those that are imperatives or nouns too (``read``) are absent."""
PAST_TENSES = word_set(
    """ate became began bit blew broke came chose did drank drew drove fell flew forgot froze gave
    got grew hid knew overran ran rang rode sang sank saw shook spoke sprang stole swam threw
    took was went were woke wore wrote"""
)
"""The irregular past tenses."""
THIRD_PERSON = word_set(
    """am are asks be becomes begins being belongs brings can carries closes comes contains
    continues could depends did differs does doing equals exists follows gets gives goes had
    happens has have having hears holds is keeps knows lacks lasts listens may meets might must
    needs obeys owns presses publishes reads remains rests says seems sees sends serves should
    sleeps stands takes tells thinks uses wants was were will wishes succeeds stays enters fails
    dies hangs would writes yields"""
)
"""The finite verbs, which state something but name nothing: ``has``, ``closes``, ``may``."""
PRESENT_PARTICIPLES = word_set(
    """acting arriving asking blocking carrying casting changing closing coming containing crowding
    differing drifting driving enclosing existing facing falling following gathering giving
    going growing hearing holding incoming keeping lacking lasting leading leaving listening
    living looking making matching meeting missing moving opening outgoing outstanding owning
    passing pending playing pressing pushing putting raising receiving remaining resting
    returning running saying seeing sending shining showing sinking sitting sleeping speaking
    speeding standing starting staying stopping surrounding taking telling touching turning
    using varying waiting walking wanting weighing working"""
)
"""Forms in -ing that describe a noun; those that are nouns (``heading``) are absent."""
NOT_PARTICIPLES = word_set(
    """bed bleed breed deed embed exceed feed greed heed hundred led misled need overspeed proceed
    reed sched seabed seed shed shred sled speed steed succeed weed zed"""
)
"""Nouns and verbs in -ed; the other words in -ed are regular participles."""

ADJECTIVES = word_set(
    """absent absolute abstract acoustic active actual adjacent aerial alive ambient angular
    apparent available awake bad bare bearable best better big blank blunt bold brief bright
    broad busy calm catchable cheap clean clear coarse cold common compact complete concrete
    consistent constant cool copyable correct crude current damp dark dead deep dense different
    dim direct dirty distant distinct doubtful dry dual due dull dynamic easy electric eligible
    empty endless entire equal essential eternal exact exclusive explicit external extra extreme
    faint fair false fatal feasible final fine finite firm first flat fluent foreign formal
    former fragile free frequent fresh full future general genuine global golden good grave
    great green handy hard harmless harsh healthy heavy high hollow homogeneous honest
    horizontal hostile hot huge idle illegal immediate implicit importable impossible inactive
    incomplete inconsistent incorrect inertial infinite inherent initial inner intact internal
    invalid invisible keen kinetic large last lateral lax lazy legal legible lenient light
    likely linear literal little live local logical lone long longitudinal loose loud low lower
    lucky major manual mere mild minor mobile modern movable mute mutual naive narrow native
    natural near neat neutral new next nice noisy nominal nonzero normal notable novel numeric
    obscure obsolete obvious odd okay old opaque open optical optional ordinary original outer
    overall overt pale parallel partial particular passable passive past perfect periodic
    permanent physical plain planar plausible poor portable possible potential precise present
    previous primary prime principal printable prior private probable prompt proper public pure
    quick quiet random rapid rare raw readable ready real rear recent rectangular redundant
    regular relative relevant reliable remote renderable reverse rich right rigid robust rough
    round safe sane scarce secondary secret secure semantic sensible separate serious severe
    shallow sharp sheer short sick silent similar simple single slack slender slight slim slow
    small smart smooth soft sole solid solvable sore sound spare sparse special specific
    spherical square stable stale standard static steady steep stern stiff strange stray strict
    strong subtle sudden sufficient suitable sure surplus swift symmetric synthetic systematic
    tall tentative textual thick thin third thorough tidy tight tiny total touchable tough
    transient transparent trivial true typical ugly ultimate unable uncertain unclear unequal
    uneven unfair unfit uniform unimodular unique universal unlikely unreadable unreliable
    unsafe unstable unsure untrue unusual upper upright urgent useful useless usual vague valid
    valuable variable various vast verbose vertical viable virtual visible visual vital void
    volatile warm weak weird wet white whole wide wild wise worse worst worth worthy writable
    writeable wrong young"""
)
NOT_ADJECTIVES = word_set("able cable callable disable enable iterable table timetable variable")
"""Nouns and verbs in -able; the other words in -able and -ible are adjectives."""
NOT_SUPERLATIVES = word_set(
    """arrest attest chest conquest contest crest digest forest guest harvest ingest interest
    invest manifest nest pest protest pytest quest request rest suggest test unittest vest west"""
)
"""Nouns and verbs in -est; the other words in -est are superlatives."""
COMPARATIVES = word_set(
    """bigger broader closer colder deeper denser faster finer greater harder heavier higher larger
    lighter longer louder narrower nearer newer odder older outermost innermost uppermost
    lowermost foremost utmost topmost redder sharper shorter simpler slower darker smaller
    softer steeper stronger taller thicker thinner tighter warmer weaker wider younger"""
)

FIGURES = word_set(
    """clark craft dawdle dive hush lean look looks nap obey onlooker onlookers room seat thing
    things touch touches unwant wish"""
)
"""Figures of speech that the style page and the glossary replace."""
WEAK_CONSTANTS = word_set("prompt quality")
"""Words that the style page names as constants which do not state what they are."""

FIELD_TERMS: dict[str, str] = {
    "left": "the side of an image, a stereo pair or a vehicle; the edge of a box",
    "right": "the side of an image, a stereo pair or a vehicle; the edge of a box",
    "up": "the unit vector of an axis (the argument of a look-at matrix in OpenGL, three.js)",
    "forward": "the unit vector of an axis (F of FRD); the sense of a rotor",
    "backward": "the sense of a rotor, opposite to forward",
    "back": "the rear face of a solid",
    "rear": "the rear face of a solid",
    "out": "the output array of a NumPy function (`out=`)",
    "low": "the lower bound in numpy.random.uniform and gymnasium.spaces.Box",
    "high": "the upper bound in numpy.random.uniform and gymnasium.spaces.Box",
    "lower": "the lower limit of a URDF joint; the lower bound in scipy.optimize",
    "upper": "the upper limit of a URDF joint; the upper bound in scipy.optimize",
    "near": "the near plane of a camera (OpenGL, three.js)",
    "far": "the far plane of a camera (OpenGL, three.js)",
    "now": "the present time: datetime.now(), rclpy Clock.now()",
    "other": "the second operand in Python's data model: __eq__(self, other)",
    "fixed": "a joint type of URDF; a scene attribute in the glossary",
    "linear": "the linear part of a ROS twist",
    "angular": "the angular part of a ROS twist",
    "visual": "an element of URDF",
    "inertial": "an element of URDF",
    "passive": "the passive forces of MuJoCo (qfrc_passive)",
    "applied": "the applied forces of MuJoCo (qfrc_applied)",
    "lost": "a tracker's status, in the glossary",
    "paired": "a kind of statistical test, in the glossary",
    "censored": "a sample without an observed end, in the glossary",
    "terminated": "the end of an episode in Gymnasium",
    "truncated": "the end of an episode by its time limit in Gymnasium",
    "latched": "a topic of ROS 1 that keeps its last message",
    "explicit": "an integration scheme, in the glossary",
    "implicit": "an integration scheme, in the glossary",
    "semantic": "a kind of segmentation, in the glossary",
    "due": "what a schedule has to do at this step, in the glossary",
    "uniform": "a distribution (numpy.random.uniform); a variable of a shader (GLSL)",
    "normal": "a surface normal; the normal distribution",
    "current": "a current of water or of electricity",
    "variable": "a variable of a program or of statistics",
    "constant": "a constant of a program or of a law",
    "standard": "a standard document",
    "literal": "a literal of a grammar or of Python (typing.Literal)",
    "square": "the square of a number; a shape",
    "solid": "a solid body of geometry",
    "prior": "a prior estimate or distribution",
    "potential": "a potential of physics",
    "secret": "the shared secret of an authentication",
    "total": "a sum",
    "original": "the original UWSim, in contrast to this program",
    "light": "a lamp; radiation",
    "sound": "acoustic waves",
    "future": "concurrent.futures.Future",
    "green": "a colour channel",
    "white": "a colour",
    "shot": "shot noise",
    "bit": "a binary digit",
    "my": "the y component of a moment (X, Y, Z, K, M, N; mx, my, mz)",
    "us": "microseconds",
    "expected": "the value to compare with in a test (pytest)",
    "actual": "the value that is compared in a test (numpy.testing)",
    "stray": "stray light",
    "first": "the first of two compared results, beside second (columns of comparison.csv)",
    "namespaced": "an element or attribute of XML that is in a namespace",
    "renderable": "an object that Rich can print (rich.console.RenderableType)",
}
"""Words of the lists above that the field uses as nouns, with the reason."""

VERBS = word_set(
    """clean clear complete correct dim direct dry empty free moderate narrow open perfect present
    prompt reverse round separate slow smooth square thin tidy warm"""
)
"""Adjectives that are verbs, too, which may name a function."""
FUNCTION_TERMS: dict[str, str] = {
    "next": "the next element of an iterator or reader (Python, ROS bags)",
    "absolute": "numpy.absolute, pathlib.Path.absolute",
}
"""Words that may name a function only, with the reason."""

BAD_PREFIXES = (
    (PREPOSITIONS - {"from", "to", "with", "on", "as", "near", "past"})
    | INTERROGATIVES
    | CONJUNCTIONS
) | word_set("each it its me mine our ours them they those too")
"""The first words of a function's name. Exceptions, each a custom of the field:

- ``from_bytes``, ``to_bytes``: constructors and conversions of Python;
- ``with_name``: a changed copy, as in pathlib;
- ``on_message``: the handler of an event, as in asyncio, paho and rclpy;
- ``near_plane``, ``past_poses``: adjectives;
- ``as_json``: a view in a data format, as ``as_dict``, ``as_posix`` (`FORMATS`).
"""
FORMATS = word_set(
    """array bytes dict euler float int integer jpeg json list matrix png posix quat rgb rgba
    rotvec str string text tuple uri yuv"""
)


@cache
def word_class(word: str) -> str | None:
    """Return the class of a word that cannot be a name alone, or None."""
    if word in FIGURES:
        return "word that the style page replaces"
    if word in FIELD_TERMS:
        return None
    for words, title in CLASSES:
        if word in words:
            return title
    if len(word) > 3 and word.endswith("ed") and word not in NOT_PARTICIPLES:
        return "participle"
    if len(word) > 4 and word.endswith("est") and word not in NOT_SUPERLATIVES:
        return "superlative"
    if len(word) > 3 and word.endswith("ly") and word not in NOT_ADVERBS:
        return "adverb"
    if word.endswith(("able", "ible")) and word not in NOT_ADJECTIVES:
        return "adjective"
    return None


CLASSES = (
    (PREPOSITIONS, "preposition"),
    (INTERROGATIVES, "interrogative"),
    (PRONOUNS, "pronoun or determiner"),
    (CONJUNCTIONS, "conjunction"),
    (PARTICIPLES | PRESENT_PARTICIPLES, "participle"),
    (PAST_TENSES | THIRD_PERSON, "finite verb"),
    (ADVERBS, "adverb"),
    (COMPARATIVES, "comparative"),
    (ADJECTIVES, "adjective"),
)
