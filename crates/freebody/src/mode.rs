//! What is active now. A motion is a chain of modes; within one, every law is smooth.

/// The arms of all switches of the force laws.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mode {
    arms: Vec<Option<bool>>,
}

impl Mode {
    /// No switch frozen: every law is read by its value.
    pub fn free(switches: usize) -> Self {
        Mode { arms: vec![None; switches] }
    }
    /// The arm at which a switch is frozen.
    pub fn arm(&self, kink: usize) -> Option<bool> {
        self.arms.get(kink).copied().flatten()
    }
    /// Freezes a switch at an arm.
    pub fn freeze(&mut self, kink: usize, arm: bool) {
        self.arms[kink] = Some(arm);
    }
}
