//! The loop of a kernel as one small tree of statements, which the interpreter walks and every target prints or compiles.
//!
//! The tree is written for one trajectory. A target that makes several side by side runs it under masks: the block of a
//! `while` or an `if` runs as long as its condition holds in any lane, and assigns in the lanes where it holds. A block's
//! own variables are assigned in all lanes, since nothing reads them in the others.

use alloc::vec;
use alloc::vec::Vec;

/// Steps after which, as at the end, a comoving frame moves on and the state is checked.
pub const BLOCK: u64 = 256;

/// The variables of the loop. The function around it has g, μ, the number of steps asked for, and whether a trajectory
/// moves on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variable {
    /// g (m).
    Element,
    /// μ (n).
    Momentum,
    /// p (u).
    Guess,
    /// The constants of the solve (k).
    Constants,
    /// x (v).
    Increment,
    /// A bound on the residual of the equation.
    ResidualBound,
    /// The distance from the first guess.
    Distance,
    /// The length of a correction.
    Moved,
    /// 1 if a step or a state is accepted.
    Right,
    /// Steps made.
    Done,
    /// Steps made in the block.
    Count,
    /// Corrections made in the step.
    Tried,
    /// Flows made of a step with kicks: one count for all trajectories side by side. Programs read the coefficients of this
    /// number.
    Flow,
}

impl Variable {
    /// All of them in order, with their names in texts.
    pub const ALL: [(Self, &'static str); 13] = [
        (Self::Element, "g"),
        (Self::Momentum, "mu"),
        (Self::Guess, "p"),
        (Self::Constants, "k"),
        (Self::Increment, "x"),
        (Self::ResidualBound, "residual_bound"),
        (Self::Distance, "distance"),
        (Self::Moved, "moved"),
        (Self::Right, "right"),
        (Self::Done, "done"),
        (Self::Count, "count"),
        (Self::Tried, "tried"),
        (Self::Flow, "flow"),
    ];

    /// Its name in texts.
    pub fn name(self) -> &'static str {
        Self::ALL[self as usize].1
    }
}

/// The programs that the loop calls: those of [`Programs`](crate::Programs) that move a state, and the kick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Part {
    Guess,
    Correct,
    Accept,
    Transport,
    Frame,
    Sound,
    Kick,
}

/// The states that are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kept {
    /// The state at the start of a block of steps.
    Block,
    /// The state at the start of a step with kicks.
    Step,
}

impl Part {
    /// All of them in order, with their names in texts.
    pub const ALL: [(Self, &'static str); 7] = [
        (Self::Guess, "guess"),
        (Self::Correct, "correct"),
        (Self::Accept, "accept"),
        (Self::Transport, "transport"),
        (Self::Frame, "frame"),
        (Self::Sound, "sound"),
        (Self::Kick, "kick"),
    ];

    /// True if it reads the coefficients of a flow, for a step with kicks.
    pub fn is_of_flow(self) -> bool {
        !matches!(self, Self::Frame | Self::Sound)
    }
}

/// A condition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Test {
    /// The trajectory moves on.
    Live,
    /// Fewer steps are made than are asked for.
    Remaining,
    /// A count is less than this number.
    Below(Variable, u32),
    /// The residual bound exceeds the tolerance, and the distance is within its limit.
    Open,
    /// [`Variable::Right`] is 1.
    Right,
}

/// A conjunction: each test must hold (`true`) or fail (`false`).
type Condition = Vec<(bool, Test)>;

/// Statements, and the variables that only they know.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// The variables and what they, or all their numbers, begin with; nothing, if they are assigned before they are read.
    pub variables: Vec<(Variable, Option<u32>)>,
    /// The statements.
    pub body: Vec<Statement>,
}

impl Block {
    /// True if a variable is one of its own.
    pub fn owns(&self, variable: Variable) -> bool {
        self.variables.iter().any(|&(own, _)| own == variable)
    }
}

/// A statement.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// Sets the times of the step that begins among the coefficients, where a target counts them; else whoever drives the loop
    /// sets them, and makes one step at a time.
    Clock,
    /// Evaluates a program and assigns its results.
    Call(Part),
    /// Adds the length of a correction to the distance.
    Lengthen,
    /// Adds 1 to a count.
    Next(Variable),
    /// Keeps the state.
    Keep(Kept),
    /// Restores that state; for a block, its steps are subtracted from those done.
    Restore(Kept),
    /// Reports the corrections and the residual bound of the step made, where a target reports them.
    Note,
    /// Stops the trajectory because its step is not right.
    RefuseStep,
    /// Stops the trajectory because its state is not right.
    RefuseState,
    /// Runs the block as long as the condition holds.
    While(Condition, Block),
    /// Runs the block if the condition holds.
    If(Condition, Block),
}

/// The loop of a kernel with at most `corrections` corrections of a step; `framed` if it has a comoving frame; `flows` are
/// those between the kicks of a step.
pub(crate) fn schedule(corrections: u32, framed: bool, flows: Option<u32>) -> Block {
    use Statement::{
        Call, Clock, If, Keep, Lengthen, Next, Note, RefuseState, RefuseStep, Restore, While,
    };
    use Test::{Below, Live, Open, Remaining, Right as IsRight};
    use Variable::*;
    let block = |variables: &[_], body| Block { variables: variables.to_vec(), body };
    let correction = vec![Call(Part::Correct), Lengthen, Next(Tried)];
    let corrections = vec![(true, Below(Tried, corrections)), (true, Open)];
    let mut refused = vec![RefuseStep];
    let mut moved = vec![Call(Part::Transport), Note];
    let counted = [Next(Done), Next(Count)];
    match flows {
        Some(_) => refused.push(Restore(Kept::Step)),
        None => moved.extend(counted.clone()),
    }
    let mut flow = vec![
        Call(Part::Guess),
        While(corrections, block(&[(Moved, Some(0))], correction)),
        Call(Part::Accept),
        If(vec![(false, IsRight)], block(&[], refused)),
        If(vec![(true, IsRight)], block(&[], moved)),
    ];
    match flows {
        Some(_) => {
            flow.insert(0, Call(Part::Kick));
            flow.push(Next(Flow));
        }
        None => flow.insert(0, Clock),
    }
    let numbers =
        [(ResidualBound, Some(1)), (Distance, Some(0)), (Right, Some(0)), (Tried, Some(0))];
    let flow = block(&[&[(Guess, None), (Constants, None)], &numbers[..]].concat(), flow);
    let step = match flows {
        None => flow,
        Some(flows) => {
            let last = [&[Call(Part::Kick)], &counted[..]].concat();
            let body = vec![
                Keep(Kept::Step),
                While(vec![(true, Live), (true, Below(Flow, flows))], flow),
                If(vec![(true, Live)], block(&[], last)),
            ];
            block(&[(Flow, Some(0))], body)
        }
    };
    let mut check = vec![Call(Part::Sound)];
    if framed {
        check.insert(0, Call(Part::Frame));
    }
    let broken = block(&[], vec![RefuseState, Restore(Kept::Block)]);
    check.push(If(vec![(false, IsRight)], broken));
    let check = block(&[(Right, Some(0))], check);
    let most = Below(Count, BLOCK as u32);
    let steps = vec![
        Keep(Kept::Block),
        While(vec![(true, Live), (true, Remaining), (true, most)], step),
        If(vec![(false, Below(Count, 1))], check),
    ];
    let steps = block(&[(Count, Some(0))], steps);
    let run = While(vec![(true, Live), (true, Remaining)], steps);
    block(&[(Increment, Some(0)), (Done, Some(0))], vec![run])
}
